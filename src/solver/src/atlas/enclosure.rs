//! The ranges of a curve's equations over a box.

use super::place::Place;
use super::search::{Cell, LegSide, Search};
use crate::interval::Interval;
use crate::jet::Jet;

/// Rounding errors of an equation, whose terms are about 1.
const ROUNDING: f64 = 1e-13;
/// Least square of a height whose root has a slope.
const LEAST: f64 = 1e-30;

/// The ranges over a box in which the curve may be.
pub(super) struct Enclosure {
    /// w2² and w3².
    pub(super) height_squares: [Interval; 2],
    /// Components of the curve's tangent, each up to a positive factor: along t, θ, w2 and w3.
    tangent: [Interval; 4],
    /// The point of the plane.
    pub(super) image: [Interval; 2],
    /// How much the equations change along t and θ.
    changes: [f64; 2],
}

fn excludes_zero(range: Interval) -> bool {
    range.low > ROUNDING || range.high < -ROUNDING
}

impl Enclosure {
    /// `None` if the curve does not meet the box, or outside of the window only.
    pub(super) fn of(search: &Search<'_>, cell: &Cell) -> Option<Self> {
        let system = &search.system;
        let place = search.chart.place(system.shape, cell.ranges);
        let [x1, second, third] = search.chart.configuration(system.shape, cell.ranges.map(Interval::middle));
        let middle = system.shape.place(&[x1, second, third, 0.0, 0.0]);
        let offsets = cell.ranges.map(|range| range.plus(-range.middle()));
        let centred = |jet: Jet, value: f64| jet.centred_at(value, offsets);
        let [h2, h3] = place.height_squares();
        let [m2, m3] = middle.height_squares();
        let heights = [centred(h2, m2), centred(h3, m3)];
        let mut w = [Jet::constant(0.0); 2];
        for leg in 0..2 {
            w[leg] = height(&heights[leg], cell.sides[leg], search.above_only[leg])?;
        }
        let (middle_w, smooth) =
            ([m2, m3].map(|square| square.max(0.0).sqrt()), smooth(&heights, cell.sides));
        let coefficients = system.target.coefficients(&place);
        let in_middle = system.target.coefficients(&middle);
        let coefficients: [Jet; 4] = std::array::from_fn(|i| centred(coefficients[i], in_middle[i]));
        let combined = |c: [Jet; 4]| c[0] + c[1] * w[0] + c[2] * w[1] + c[3] * (w[0] * w[1]);
        let mut value = combined(coefficients);
        let signed: [f64; 2] = std::array::from_fn(|leg| cell.sides[leg].sign() * middle_w[leg]);
        if smooth {
            let [a, b, c, d] = in_middle;
            value = centred(value, a + b * signed[0] + c * signed[1] + d * signed[0] * signed[1]);
        }
        if excludes_zero(value.value) {
            return None;
        }
        let image = Self::image_range(search, (&place, &middle), w, signed, smooth, &offsets)?;
        let tangent = tangent(&coefficients, &value, &heights, &w, smooth);
        let width = |axis: usize| cell.ranges[axis].high - cell.ranges[axis].low;
        let change = |axis: usize| {
            let of = |jet: &Jet| jet.slopes[axis].magnitude();
            let of_heights = heights.iter().map(of).fold(0.0, f64::max);
            (coefficients.iter().map(of).sum::<f64>() + of_heights) * width(axis)
        };
        Some(Self {
            height_squares: heights.map(|jet| jet.value),
            tangent,
            image,
            changes: [change(0), change(1)],
        })
    }

    fn image_range(
        search: &Search<'_>,
        (place, middle): (&Place<'_, Jet>, &Place<'_, f64>),
        w: [Jet; 2],
        signed: [f64; 2],
        smooth: bool,
        offsets: &[Interval; 2],
    ) -> Option<[Interval; 2]> {
        let (jets, factor) = place.image(search.system.space);
        let (numbers, _) = middle.image(search.system.space);
        let mut image = [Interval::ZERO; 2];
        for i in 0..2 {
            let jet = if smooth {
                let whole = jets[i] + w[i].times(factor);
                whole.centred_at(numbers[i] + factor * signed[i], *offsets)
            } else {
                jets[i].centred_at(numbers[i], *offsets) + w[i].times(factor)
            };
            image[i] = jet.value;
            image[i].intersection(search.window[i])?;
        }
        Some(image)
    }

    /// Whether a component of the tangent has the same sign all over the box.
    pub(super) fn tangent_has_a_sign(&self) -> bool {
        self.tangent.iter().any(|component| component.sign() != 0)
    }

    /// Whether the curve crosses an edge of constant t or θ everywhere in the same sense.
    pub(super) fn crosses_once(&self, axis: usize) -> bool {
        self.tangent[axis].sign() != 0
    }

    /// The larger side of the image.
    pub(super) fn image_size(&self) -> f64 {
        self.image.iter().map(|range| range.high - range.low).fold(0.0, f64::max)
    }

    /// The axis along which the equations change more.
    pub(super) fn axis(&self) -> usize {
        usize::from(self.changes[1] > self.changes[0])
    }
}

/// The height of a leg on a side; `None` if it does not reach, or is not level where it must be.
fn height(square: &Jet, side: LegSide, above_only: bool) -> Option<Jet> {
    let range = square.value;
    if range.high < 0.0 {
        return None;
    }
    let unknown = |value: Interval| Jet { value, slopes: [Interval::ALL; 2] };
    match side {
        LegSide::Level if range.low > 0.0 => None,
        LegSide::Level => Some(Jet::constant(0.0)),
        LegSide::Either => {
            let most = range.high.sqrt();
            Some(unknown(Interval::new(if above_only { 0.0 } else { -most }, most)))
        }
        LegSide::Above => Some(square.root(LEAST)),
        LegSide::Below => Some(-square.root(LEAST)),
    }
}

/// Whether both heights are functions with known slopes.
fn smooth(heights: &[Jet; 2], sides: [LegSide; 2]) -> bool {
    (0..2).all(|leg| match sides[leg] {
        LegSide::Above | LegSide::Below => heights[leg].value.low > LEAST,
        LegSide::Level => true,
        LegSide::Either => false,
    })
}

/// The tangent's components. In the space of t, θ, w2 and w3 the tangent is perpendicular to the gradients of D, of
/// h2 - w2² and of h3 - w3², where D is the target.
fn tangent(
    coefficients: &[Jet; 4],
    value: &Jet,
    [h2, h3]: &[Jet; 2],
    w: &[Jet; 2],
    smooth: bool,
) -> [Interval; 4] {
    let [w2, w3] = w.map(|w| w.value);
    if smooth && w2.sign() != 0 && w3.sign() != 0 {
        // The derivatives of D along t and θ, with both heights as functions of these.
        return [value.slopes[1], -value.slopes[0], Interval::ALL, Interval::ALL];
    }
    let [_, b, c, d] = coefficients;
    let (along_w2, along_w3) = (b.value + d.value * w3, c.value + d.value * w2);
    let target = [0, 1].map(|axis| {
        let [a, b, c, d] = coefficients.map(|jet| jet.slopes[axis]);
        a + b * w2 + c * w3 + d * w2 * w3
    });
    let bracket = |f: [Interval; 2], g: [Interval; 2]| f[0] * g[1] - f[1] * g[0];
    let component = |axis: usize| {
        (w2 * w3 * target[axis]).times(4.0)
            + (w3 * along_w2 * h2.slopes[axis]).times(2.0)
            + (w2 * along_w3 * h3.slopes[axis]).times(2.0)
    };
    [
        component(1),
        -component(0),
        (w3 * bracket(h2.slopes, target)).times(2.0) + along_w3 * bracket(h2.slopes, h3.slopes),
        (w2 * bracket(h3.slopes, target)).times(2.0) + along_w2 * bracket(h3.slopes, h2.slopes),
    ]
}
