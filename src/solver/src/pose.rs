//! Positions and orientations. Millimetres and radians.

/// A point in some Cartesian frame, mm.
pub type Point = [f64; 3];

/// Pose of the platform frame in the base frame (Eq (1)).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlatformPose {
    /// x of P, mm.
    pub x: f64,
    /// y of P, mm.
    pub y: f64,
    /// z of P, mm; z points down.
    pub z: f64,
    /// Rotation of the platform about x, in (-π, π], rad.
    pub alpha: f64,
}

/// Pose of the tool in the part frame (Eq (8)).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PartPose {
    /// The tool centre point, mm.
    pub x: f64,
    /// The tool centre point, mm.
    pub y: f64,
    /// The tool centre point, mm; up from the table.
    pub z: f64,
    /// Inclination of the tool, rad.
    pub phi1: f64,
    /// Azimuth of the tool, rad.
    pub phi2: f64,
}

/// Angles of the tilting table (Eq (7)).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TableAngles {
    /// Tilting angle, about x, rad.
    pub theta1: f64,
    /// Rotary angle, about the tilted table's normal, rad.
    pub theta2: f64,
}
