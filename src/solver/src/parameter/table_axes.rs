//! The part frame on a table whose axes deviate, and the rates of a point and a direction seen from it.

use nalgebra::{Rotation3, Unit, Vector3};

use super::{MACHINE_FRAME_PARAMETERS, PARAMETERS, Parameter};
use crate::pose::TableAngles;

/// The number of the table's parameters.
const TABLE_PARAMETERS: usize = PARAMETERS - MACHINE_FRAME_PARAMETERS;

/// A point, or a direction, seen from the part frame.
struct Seen {
    vector: Vector3<f64>,
    /// Its derivatives by the table's parameters, in the order of [`Parameter::ALL`].
    rates: [Vector3<f64>; TABLE_PARAMETERS],
}

/// The position of the part frame in the base frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct PartFrame {
    /// Origin of the tilting axis in the base frame.
    tilt_origin: Vector3<f64>,
    /// The table's origin in the frame of the tilting axis.
    rotary_origin: Vector3<f64>,
    /// The rotations from the base frame to that of the tilting axis, in this order.
    tilt: [(Parameter, Rotation3<f64>); 3],
    /// The rotation of the rotary axis out of its nominal direction.
    rotary_b: Rotation3<f64>,
    /// The rotation about the rotary axis.
    rotary: Rotation3<f64>,
}

/// Half a turn about x.
fn turned_over(v: Vector3<f64>) -> Vector3<f64> {
    Vector3::new(v.x, -v.y, -v.z)
}

/// The axis of a parameter that is an angle.
fn axis_of(parameter: Parameter) -> Unit<Vector3<f64>> {
    match parameter {
        Parameter::TiltAxisC | Parameter::RotaryZero => Vector3::z_axis(),
        Parameter::TiltZero => Vector3::x_axis(),
        _ => Vector3::y_axis(),
    }
}

/// The rotation of a frame by `angle` about the parameter's axis, as its inverse.
fn inverse_rotation(parameter: Parameter, angle: f64) -> Rotation3<f64> {
    Rotation3::from_axis_angle(&axis_of(parameter), -angle)
}

impl PartFrame {
    /// The frame for the values of the parameters and the angles that the control indicates.
    pub(super) fn new(value: impl Fn(Parameter) -> f64, table: TableAngles) -> Self {
        use Parameter as P;
        let turn = |parameter, indicated: f64| inverse_rotation(parameter, indicated + value(parameter));
        Self {
            tilt_origin: Vector3::new(0.0, value(P::TiltAxisY), value(P::da)),
            rotary_origin: Vector3::new(value(P::RotaryAxisX), value(P::RotaryAxisY), value(P::dt)),
            tilt: [(P::TiltAxisC, 0.0), (P::TiltAxisB, 0.0), (P::TiltZero, table.theta1)]
                .map(|(parameter, indicated)| (parameter, turn(parameter, indicated))),
            rotary_b: turn(P::RotaryAxisB, 0.0),
            rotary: turn(P::RotaryZero, table.theta2),
        }
    }

    /// A direction of the base frame in the part frame.
    pub(super) fn direction(&self, direction: Vector3<f64>) -> Vector3<f64> {
        self.rotary * turned_over(self.rotary_b * self.tilted(direction))
    }

    /// A point of the base frame in the part frame.
    pub(super) fn point(&self, point: Vector3<f64>) -> Vector3<f64> {
        let tilted = self.tilted(point - self.tilt_origin) - self.rotary_origin;
        self.rotary * turned_over(self.rotary_b * tilted)
    }

    /// Derivatives of a point by the table's parameters.
    pub(super) fn point_rates(&self, point: Vector3<f64>) -> [Vector3<f64>; TABLE_PARAMETERS] {
        let mut seen = Seen::new(point - self.tilt_origin);
        seen.add(Parameter::da, -Vector3::z());
        seen.add(Parameter::TiltAxisY, -Vector3::y());
        self.tilt(&mut seen);
        seen.vector -= self.rotary_origin;
        seen.add(Parameter::dt, -Vector3::z());
        seen.add(Parameter::RotaryAxisX, -Vector3::x());
        seen.add(Parameter::RotaryAxisY, -Vector3::y());
        self.turn(&mut seen);
        seen.rates
    }

    /// Derivatives of a direction by the table's parameters.
    pub(super) fn direction_rates(&self, direction: Vector3<f64>) -> [Vector3<f64>; TABLE_PARAMETERS] {
        let mut seen = Seen::new(direction);
        self.tilt(&mut seen);
        self.turn(&mut seen);
        seen.rates
    }

    fn tilted(&self, vector: Vector3<f64>) -> Vector3<f64> {
        self.tilt.iter().fold(vector, |vector, (_, rotation)| rotation * vector)
    }

    fn tilt(&self, seen: &mut Seen) {
        for (parameter, rotation) in &self.tilt {
            seen.rotate(*parameter, rotation);
        }
    }

    fn turn(&self, seen: &mut Seen) {
        seen.rotate(Parameter::RotaryAxisB, &self.rotary_b);
        seen.vector = turned_over(seen.vector);
        seen.rates = seen.rates.map(turned_over);
        seen.rotate(Parameter::RotaryZero, &self.rotary);
    }
}

impl Seen {
    fn new(vector: Vector3<f64>) -> Self {
        Self { vector, rates: [Vector3::zeros(); TABLE_PARAMETERS] }
    }

    fn add(&mut self, parameter: Parameter, rate: Vector3<f64>) {
        self.rates[parameter.index() - MACHINE_FRAME_PARAMETERS] += rate;
    }

    /// Applies the inverse rotation of a parameter that is an angle: d/dt Rot(k, -t) v = -k × Rot(k, -t) v.
    fn rotate(&mut self, parameter: Parameter, rotation: &Rotation3<f64>) {
        self.vector = rotation * self.vector;
        self.rates = self.rates.map(|rate| rotation * rate);
        self.add(parameter, -axis_of(parameter).cross(&self.vector));
    }
}
