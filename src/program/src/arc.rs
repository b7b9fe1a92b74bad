//! Arcs of the tip: circles, helices, and spirals within the tolerance of programs.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// An arc of the tip, right-handed about its normal. Start and end are those of the move.
///
/// Angle, radius and height along the normal change linearly in the path parameter. So an arc with an end above its
/// start is a helix, and one whose end misses the radius a little still ends at its end.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Arc {
    centre: [f64; 3],
    normal: [f64; 3],
    sweep: f64,
}

/// How far an arc turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Sweep {
    /// To the end, and so many whole turns before. The way to an end on the start is a full turn.
    ToEnd {
        /// Whole turns.
        turns: u16,
    },
    /// About so many radians, and exactly to the end.
    About(f64),
}

/// Start and end coincide within this distance in mm if the arc is a full circle.
const SAME_POINT: f64 = 1e-6;
/// An end may miss the circle by this many mm, and by a thousandth of the radius.
const MISS: f64 = 0.01;
/// A stated angle may differ from the angle between start and end by so many radians.
const ANGLE_MISS: f64 = 2e-3;
/// The most whole turns of an arc.
const MOST_TURNS: f64 = 1000.0;

impl Arc {
    /// An arc, or a sentence that says what is wrong. `normal` is a unit vector.
    pub(crate) fn new(
        start: [f64; 3],
        end: [f64; 3],
        centre: [f64; 3],
        normal: [f64; 3],
        sweep: Sweep,
    ) -> Result<Self, String> {
        let from = Polar::of(start, centre, normal);
        let to = Polar::of(end, centre, normal);
        if from.radius < SAME_POINT {
            return Err("the arc begins at its centre; the present point must lie on the circle".to_owned());
        }
        let miss = (to.radius - from.radius).abs();
        if miss > MISS + 1e-3 * from.radius {
            return Err(format!(
                "the end misses the circle of radius {:.6} mm by {miss:.6} mm; accepted are 0.01 mm and 0.1 % of \
                 the radius",
                from.radius
            ));
        }
        let turn = from.angle_to(&to, normal);
        let chord = (to.direction * to.radius - from.direction * from.radius).norm();
        let sweep = match sweep {
            Sweep::ToEnd { turns } if chord <= SAME_POINT => TAU * (f64::from(turns) + 1.0),
            Sweep::ToEnd { turns } => turn + TAU * f64::from(turns),
            Sweep::About(stated) => {
                let exact = turn + TAU * ((stated - turn) / TAU).round();
                if exact <= 0.0 || (exact - stated).abs() > ANGLE_MISS + MISS / from.radius {
                    return Err(format!(
                        "the stated angle is {:.4} degrees, but the end lies at {:.4} degrees",
                        stated.to_degrees(),
                        turn.to_degrees()
                    ));
                }
                exact
            }
        };
        if sweep > TAU * MOST_TURNS {
            return Err("an arc has at most 1000 turns".to_owned());
        }
        Ok(Self { centre, normal, sweep })
    }

    /// The centre in mm, somewhere on the axis of the arc.
    pub fn centre(&self) -> [f64; 3] {
        self.centre
    }

    /// The unit vector about which the arc turns right-handed.
    pub fn normal(&self) -> [f64; 3] {
        self.normal
    }

    /// The angle from start to end in radians: positive, more than a turn for a helix of several turns.
    pub fn sweep(&self) -> f64 {
        self.sweep
    }

    /// The tip at the path parameter `t` from 0 at `start` to 1 at `end`.
    pub(crate) fn point(&self, start: [f64; 3], end: [f64; 3], t: f64) -> [f64; 3] {
        if t <= 0.0 {
            return start;
        }
        if t >= 1.0 {
            return end;
        }
        let normal = Vector3::from(self.normal);
        let from = Polar::of(start, self.centre, self.normal);
        let to = Polar::of(end, self.centre, self.normal);
        let (sine, cosine) = (self.sweep * t).sin_cos();
        let direction = from.direction * cosine + normal.cross(&from.direction) * sine;
        let radius = from.radius + (to.radius - from.radius) * t;
        let height = from.height + (to.height - from.height) * t;
        (Vector3::from(self.centre) + direction * radius + normal * height).into()
    }

    /// The length in mm, with the mean radius.
    pub(crate) fn length(&self, start: [f64; 3], end: [f64; 3]) -> f64 {
        let from = Polar::of(start, self.centre, self.normal);
        let to = Polar::of(end, self.centre, self.normal);
        let round = self.sweep * f64::midpoint(from.radius, to.radius);
        round.hypot(to.height - from.height)
    }

    /// Path parameters where a coordinate is extreme, but for the pitch of a helix: in the first and the last turns.
    pub(crate) fn extremes(&self, start: [f64; 3]) -> Vec<f64> {
        let from = Polar::of(start, self.centre, self.normal);
        let across = Vector3::from(self.normal).cross(&from.direction);
        let mut parameters = Vec::new();
        for k in 0..3 {
            let first = across[k].atan2(from.direction[k]).rem_euclid(2.0 * FRAC_PI_2);
            let count = ((self.sweep - first) / (2.0 * FRAC_PI_2)).floor() + 1.0;
            let mut n = 0.0;
            while n < count {
                parameters.push((first + 2.0 * FRAC_PI_2 * n) / self.sweep);
                n = if n == 3.0 && count > 8.0 { count - 4.0 } else { n + 1.0 };
            }
        }
        parameters
    }

    /// Whether the arc is one that a reader makes.
    pub(crate) fn is_valid(&self) -> bool {
        self.centre.iter().all(|n| n.is_finite())
            && crate::orientation::unit(self.normal) == Some(self.normal)
            && self.sweep > 0.0
            && self.sweep <= TAU * MOST_TURNS
    }
}

/// A point relative to the axis of a circle.
pub(crate) struct Polar {
    /// Distance from the axis.
    pub(crate) radius: f64,
    /// Unit vector from the axis to the point; zero on the axis.
    direction: Vector3<f64>,
    /// Distance from the centre along the normal.
    pub(crate) height: f64,
}

impl Polar {
    pub(crate) fn of(point: [f64; 3], centre: [f64; 3], normal: [f64; 3]) -> Self {
        let normal = Vector3::from(normal);
        let from_centre = Vector3::from(point) - Vector3::from(centre);
        let height = from_centre.dot(&normal);
        let radial = from_centre - normal * height;
        let radius = radial.norm();
        let direction = if radius > 0.0 { radial / radius } else { Vector3::zeros() };
        Self { radius, direction, height }
    }

    /// The angle from this point to another, right-handed about the normal, from 0 to below a turn.
    pub(crate) fn angle_to(&self, other: &Self, normal: [f64; 3]) -> f64 {
        let sine = Vector3::from(normal).dot(&self.direction.cross(&other.direction));
        let angle = sine.atan2(self.direction.dot(&other.direction)).rem_euclid(TAU);
        if angle < TAU { angle } else { 0.0 }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "what a test cannot prepare has failed it")]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI, TAU};

    use super::{Arc, Sweep};

    const UP: [f64; 3] = [0.0, 0.0, 1.0];

    fn arc(start: [f64; 3], end: [f64; 3], normal: [f64; 3], sweep: Sweep) -> Result<Arc, String> {
        Arc::new(start, end, [0.0; 3], normal, sweep)
    }

    #[test]
    fn an_arc_turns_right_handed_about_its_normal() {
        let (start, end) = ([10.0, 0.0, 0.0], [0.0, 10.0, 0.0]);
        let quarter = arc(start, end, UP, Sweep::ToEnd { turns: 0 }).unwrap();
        assert!((quarter.sweep() - FRAC_PI_2).abs() < 1e-15);
        let other = arc(start, end, [0.0, 0.0, -1.0], Sweep::ToEnd { turns: 0 }).unwrap();
        assert!((other.sweep() - 3.0 * FRAC_PI_2).abs() < 1e-15);
        let middle = other.point(start, end, 0.5);
        let expected = [-(50_f64.sqrt()), -(50_f64.sqrt()), 0.0];
        assert!(middle.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{middle:?}");
    }

    #[test]
    fn an_end_on_the_start_is_a_full_circle_and_an_end_above_it_a_helix() {
        let start = [10.0, 0.0, 0.0];
        let circle = arc(start, start, UP, Sweep::ToEnd { turns: 0 }).unwrap();
        assert_eq!(circle.sweep(), TAU);
        let end = [10.0, 0.0, 3.0];
        let helix = arc(start, end, UP, Sweep::ToEnd { turns: 0 }).unwrap();
        assert_eq!(helix.sweep(), TAU);
        assert!((helix.point(start, end, 0.5)[2] - 1.5).abs() < 1e-15);
        assert!((helix.length(start, end) - (10.0 * TAU).hypot(3.0)).abs() < 1e-12);
    }

    #[test]
    fn a_stated_angle_decides_the_turns_and_must_fit_the_end() {
        let (start, end) = ([10.0, 0.0, 0.0], [-10.0, 0.0, 0.0]);
        let stated = |degrees: f64| arc(start, end, UP, Sweep::About(degrees.to_radians()));
        assert!((stated(180.0).unwrap().sweep() - PI).abs() < 1e-15);
        assert!((stated(540.0).unwrap().sweep() - 3.0 * PI).abs() < 1e-12);
        assert!(stated(90.0).is_err());
        assert!(stated(-180.0).is_err());
    }

    #[test]
    fn an_end_beside_the_circle_is_refused() {
        let start = [10.0, 0.0, 0.0];
        assert!(arc(start, [0.0, 10.015, 0.0], UP, Sweep::ToEnd { turns: 0 }).is_ok());
        assert!(arc(start, [0.0, 10.03, 0.0], UP, Sweep::ToEnd { turns: 0 }).is_err());
        assert!(arc([0.0; 3], [0.0, 10.0, 0.0], UP, Sweep::ToEnd { turns: 0 }).is_err());
    }
}
