//! One triangle's geometry.

use crate::vector::{cross, dot, norm, scale, sub};

/// Fraction of the longest edge below which a height is rounding error, and a normal computed from it is noise.
const FLAT: f64 = 1e-12;

/// The outward unit normal; `None` if the corners lie on a line.
pub(crate) fn normal([a, b, c]: [[f64; 3]; 3]) -> Option<[f64; 3]> {
    let (ab, bc, ca) = (sub(b, a), sub(c, b), sub(a, c));
    let longest_squared = dot(ab, ab).max(dot(bc, bc)).max(dot(ca, ca));
    let twice = cross(ab, sub(c, a));
    let twice_area = norm(twice);
    // The comparison treats an overflow or a NaN as flat.
    (twice_area > FLAT * longest_squared && twice_area.is_finite()).then(|| scale(twice, twice_area.recip()))
}

/// The triangle's area.
pub(crate) fn area([a, b, c]: [[f64; 3]; 3]) -> f64 {
    norm(cross(sub(b, a), sub(c, a))) / 2.0
}

/// The angle at the corner `at`, between the directions to the two others.
pub(crate) fn angle(corners: [[f64; 3]; 3], at: usize) -> f64 {
    let apex = corners[at];
    let (u, v) = (sub(corners[(at + 1) % 3], apex), sub(corners[(at + 2) % 3], apex));
    norm(cross(u, v)).atan2(dot(u, v))
}

#[cfg(test)]
mod tests {
    use super::{angle, area, normal};

    #[test]
    fn a_right_triangle_has_exact_normal_area_and_angles() {
        let corners = [[5.0, 0.0, 7.0], [9.0, 0.0, 7.0], [5.0, 3.0, 7.0]];
        assert_eq!(normal(corners), Some([0.0, 0.0, 1.0]));
        assert_eq!(area(corners), 6.0);
        assert!((angle(corners, 0).to_degrees() - 90.0).abs() < 1e-12);
        assert!((angle(corners, 1).tan() - 0.75).abs() < 1e-12);
    }

    #[test]
    fn three_points_on_a_line_have_no_normal() {
        assert_eq!(normal([[0.0; 3], [1.0, 1.0, 1.0], [3.0, 3.0, 3.0]]), None);
        assert_eq!(normal([[0.1; 3], [0.1; 3], [0.1; 3]]), None);
        // A tenth is not a binary fraction: the cross product of this line is not quite zero.
        assert_eq!(normal([[0.1, 0.2, 0.3], [1.1, 1.3, 1.7], [2.1, 2.4, 3.1]]), None);
    }
}
