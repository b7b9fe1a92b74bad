//! The search for all assemblies over boxes of the angles (φ, θ).
//!
//! A box is dropped if an equation's enclosure excludes zero there. It has exactly one solution if the operator of
//! Krawczyk maps a slightly larger box into itself, and none if the image of the larger box misses it (R. Krawczyk,
//! 1969, [doi:10.1007/BF02234767](https://doi.org/10.1007/BF02234767)). Otherwise it is halved. The enclosures do not
//! round outwards; they allow for the rounding of the equations.

use std::f64::consts::{PI, TAU};

use super::leg_one_chart::LegOneChart;
use crate::interval::Interval;

/// Boxes at the start, along φ. Each holds all θ.
const STRIPS: u32 = 32;
/// Shift of the first box from -π: the machine's symmetry plane lies within boxes.
const SHIFT: f64 = 0.0173;
/// By how much the examined box is wider than the box itself.
const WIDENED: f64 = 1.25;
/// Width, rad, at which a box is not halved further: two solutions within it have merged.
const NARROWEST: f64 = 1e-8;
/// Rounding errors of an equation relative to the magnitude of its terms.
const ROUNDING: f64 = 1e-14;
/// Boxes after which the search ends: solutions form a curve.
const MOST_BOXES: u32 = 6_000;
/// Newton steps from the middle of a box with one solution.
const STEPS: usize = 8;

/// A place of the search with a solution.
#[derive(Clone, Copy, Debug)]
pub(super) struct FoundAngles {
    pub(super) angles: [f64; 2],
    /// Whether the box became too narrow to decide the number of its solutions.
    pub(super) merged: bool,
}

/// The solutions form a curve, or nearly so.
pub(super) struct TooManyBoxes;

type AngleBox = [Interval; 2];

/// The outcome for one box.
enum Verdict {
    Empty,
    One([f64; 2]),
    Halve(usize),
}

/// Finds all solutions. A solution on the edge of two boxes is found twice.
#[cold]
pub(super) fn all_angles(chart: &LegOneChart) -> Result<Vec<FoundAngles>, TooManyBoxes> {
    let width = TAU / f64::from(STRIPS);
    let strip = |i: u32| {
        let low = SHIFT - PI + f64::from(i) * width;
        [Interval::new(low, low + width), Interval::around(PI)]
    };
    let mut boxes: Vec<AngleBox> = (0..STRIPS).map(strip).collect();
    let (mut found, mut count) = (Vec::new(), 0);
    while let Some(angles) = boxes.pop() {
        count += 1;
        if count > MOST_BOXES {
            return Err(TooManyBoxes);
        }
        match examined(chart, &angles) {
            Verdict::Empty => {}
            Verdict::One(at) => found.push(FoundAngles { angles: newton(chart, at), merged: false }),
            Verdict::Halve(axis) if angles[axis].high - angles[axis].low < NARROWEST => {
                found.push(FoundAngles { angles: angles.map(Interval::middle), merged: true });
            }
            Verdict::Halve(axis) => {
                let middle = angles[axis].middle();
                let [mut below, mut above] = [angles, angles];
                below[axis].high = middle;
                above[axis].low = middle;
                boxes.extend([below, above]);
            }
        }
    }
    Ok(found)
}

fn examined(chart: &LegOneChart, angles: &AngleBox) -> Verdict {
    let centre = angles.map(Interval::middle);
    let half = angles.map(|angle| 0.5 * (angle.high - angle.low));
    let wide = [0, 1].map(|axis| Interval::around(WIDENED * half[axis]));
    let Some(jets) = chart.equations([0, 1].map(|axis| wide[axis].plus(centre[axis]))) else {
        return Verdict::Empty;
    };
    let slack = chart.magnitudes.map(|magnitude| ROUNDING * magnitude);
    let excludes_zero = |range: Interval, i: usize| range.low > slack[i] || range.high < -slack[i];
    if (0..2).any(|i| excludes_zero(jets[i].value, i)) {
        return Verdict::Empty;
    }
    // The coordinate along which the equations change most.
    let change = |axis: usize| {
        let of = |i: usize| jets[i].slopes[axis].magnitude() * half[axis] / chart.magnitudes[i];
        of(0).max(of(1))
    };
    let axis = usize::from(change(1) > change(0));
    let Some(here) = chart.equations(centre.map(Interval::of)) else { return Verdict::Halve(axis) };
    let values = here.map(|jet| jet.value.low);
    let own = half.map(Interval::around);
    let mean_value = |i: usize| (jets[i].slopes[0] * own[0] + jets[i].slopes[1] * own[1]).plus(values[i]);
    if (0..2).any(|i| excludes_zero(mean_value(i), i)) {
        return Verdict::Empty;
    }
    let rates = jets.map(|jet| jet.slopes.map(Interval::middle));
    let Some(inverse) = inverse(rates) else { return Verdict::Halve(axis) };
    // K - centre = -Y g(centre) + (1 - Y J) (box - centre).
    let image = [0, 1].map(|row| {
        let [a, b] = inverse[row];
        let rest = |column: usize| {
            let product = jets[0].slopes[column].times(a) + jets[1].slopes[column].times(b);
            let unit = if row == column { 1.0 } else { 0.0 };
            Interval::of(unit) - product
        };
        let slack = Interval::around(a.abs() * slack[0] + b.abs() * slack[1]);
        (rest(0) * wide[0] + rest(1) * wide[1] + slack).plus(-(a * values[0] + b * values[1]))
    });
    if (0..2).any(|i| image[i].intersection(own[i]).is_none()) {
        return Verdict::Empty;
    }
    if (0..2).all(|i| image[i].low > wide[i].low && image[i].high < wide[i].high) {
        return Verdict::One([0, 1].map(|i| centre[i] + image[i].middle()));
    }
    Verdict::Halve(axis)
}

/// Newton's method from angles next to a solution.
fn newton(chart: &LegOneChart, start: [f64; 2]) -> [f64; 2] {
    let mut angles = start;
    for _ in 0..STEPS {
        let Some(here) = chart.equations(angles.map(Interval::of)) else { break };
        let Some(inverse) = inverse(here.map(|jet| jet.slopes.map(|slope| slope.low))) else { break };
        let values = here.map(|jet| jet.value.low);
        let step = inverse.map(|[a, b]| a * values[0] + b * values[1]);
        angles = [angles[0] - step[0], angles[1] - step[1]];
        if step[0].abs().max(step[1].abs()) < 1e-15 {
            break;
        }
    }
    angles
}

/// The inverse of a 2×2 matrix; `None` if it has none in double precision.
fn inverse([[a, b], [c, d]]: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
    let scale = 1.0 / (a * d - b * c);
    scale.is_finite().then(|| [[d * scale, -b * scale], [-c * scale, a * scale]])
}
