//! The program's frame in the part frame.

use crate::wire::degrees::from_degrees;
use crate::wire::toolpath::Setup;

/// Sines and cosines below this are rounding of right angles.
const ROUNDING: f64 = 1e-15;

/// A rotation by rows and an origin, mm, in the part frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frame {
    pub(crate) rotation: [[f64; 3]; 3],
    origin: [f64; 3],
}

impl Frame {
    /// p = T + Rot(z, c) Rot(y, b) Rot(x, a) p'.
    pub(crate) fn of(setup: &Setup) -> Self {
        let Setup { x, y, z, a, b, c } = *setup;
        let [(sa, ca), (sb, cb), (sc, cc)] = [a, b, c].map(|degrees| {
            let (sin, cos) = from_degrees(degrees).sin_cos();
            (exact(sin), exact(cos))
        });
        let rotation = [
            [cc * cb, cc * sb * sa - sc * ca, cc * sb * ca + sc * sa],
            [sc * cb, sc * sb * sa + cc * ca, sc * sb * ca - cc * sa],
            [-sb, cb * sa, cb * ca],
        ];
        Self { rotation, origin: [x, y, z] }
    }

    /// The angle that the frame is turned by about z, rad, if its z is that of the part frame.
    pub(crate) fn azimuth(&self) -> f64 {
        let [[cosine, ..], [sine, ..], _] = self.rotation;
        sine.atan2(cosine)
    }

    /// A point of the program, mm.
    pub(crate) fn point(&self, point: [f64; 3]) -> [f64; 3] {
        let turned = self.direction(point);
        std::array::from_fn(|i| self.origin[i] + turned[i])
    }

    /// A direction of the program. No component is -0.
    pub(crate) fn direction(&self, v: [f64; 3]) -> [f64; 3] {
        self.rotation.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2] + 0.0)
    }
}

/// Right angles turn axes onto axes exactly.
fn exact(number: f64) -> f64 {
    if number.abs() < ROUNDING { 0.0 } else { number }
}

#[cfg(test)]
mod tests {
    use super::Frame;
    use crate::wire::toolpath::Setup;

    #[test]
    fn a_frame_turns_about_x_then_y_then_z_and_moves() {
        let frame = Frame::of(&Setup { x: 1.0, y: 2.0, z: 3.0, a: 90.0, b: 0.0, c: 90.0 });
        // y' becomes z, z' becomes -y and then x.
        assert_eq!(frame.point([0.0, 10.0, 0.0]), [1.0, 2.0, 13.0]);
        assert_eq!(frame.direction([0.0, 0.0, 1.0]), [1.0, 0.0, 0.0]);
        let tilted = Frame::of(&Setup { b: 30.0, ..Setup::default() }).direction([0.0, 0.0, 1.0]);
        assert!((tilted[0] - 0.5).abs() < 1e-15 && tilted[1] == 0.0, "{tilted:?}");
    }

    #[test]
    fn no_set_up_changes_no_bit() {
        let point = [0.1, -1e-17, 1e7 / 3.0];
        assert_eq!(Frame::of(&Setup::default()).point(point), point);
    }
}
