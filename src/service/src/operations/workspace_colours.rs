//! Colours of the constraints that bound a workspace.

use std::collections::BTreeMap;

use verne_mesh::Swatch;
use verne_solver::Constraint;
use verne_solver::workspace::Binding;

use crate::wire::constraint::{ConstraintName, ElementName};

/// The share of white in the colour of the last element of a constraint that seldom bounds a workspace. The first
/// element has none.
const LIGHTEST: f64 = 0.5;

/// A tag for each triangle, and the names and colours of the tags, such as `stroke slider1.max`. Only constraints that
/// occur have a tag; their order is fixed.
pub(crate) fn tags_and_palette(bindings: &[Binding]) -> (Vec<u8>, Vec<Swatch>) {
    let mut names = BTreeMap::new();
    // A surface has long runs of one binding.
    for run in bindings.chunk_by(|a, b| a == b) {
        names.extend(run.first().map(|&binding| (key(binding), 0_u8)));
    }
    let shared = |constraint, element: &str| own_colour(constraint, element).is_none();
    let mut elements = BTreeMap::new();
    for (constraint, _) in names.keys().filter(|(constraint, element)| shared(*constraint, element)) {
        *elements.entry(*constraint).or_insert(0_u8) += 1;
    }
    let mut palette = Vec::with_capacity(names.len());
    let mut seen = BTreeMap::new();
    for (tag, ((constraint, element), number)) in (0..).zip(&mut names) {
        *number = tag;
        let rgb = own_colour(*constraint, element).unwrap_or_else(|| {
            let step = seen.entry(*constraint).or_insert(0_u8);
            let steps = elements.get(constraint).map_or(1, |count| count.saturating_sub(1).max(1));
            let white = LIGHTEST * f64::from(*step) / f64::from(steps);
            *step += 1;
            lighter(shared_colour(*constraint), white)
        });
        palette.push(Swatch { name: format!("{} {element}", ConstraintName(*constraint)), rgb });
    }
    let mut last = None;
    let tag = |&binding: &Binding| match last {
        Some((known, tag)) if known == binding => tag,
        _ => {
            let tag = names.get(&key(binding)).copied().unwrap_or_default();
            last = Some((binding, tag));
            tag
        }
    };
    (bindings.iter().map(tag).collect(), palette)
}

fn key(binding: Binding) -> (Constraint, String) {
    (binding.constraint, ElementName::from(binding).to_string())
}

/// The colours of the limits that bound most workspaces. A search placed them as far from each other as it could, for
/// normal and for colour-blind eyes; a test keeps their distances.
const OWN: [(Constraint, &str, [u8; 3]); 15] = [
    (Constraint::Stroke, "slider1.min", [162, 126, 255]),
    (Constraint::Stroke, "slider1.max", [5, 44, 177]),
    (Constraint::Stroke, "slider2.min", [187, 178, 255]),
    (Constraint::Stroke, "slider2.max", [49, 56, 254]),
    (Constraint::Stroke, "slider3.min", [137, 98, 172]),
    (Constraint::Stroke, "slider3.max", [88, 1, 94]),
    (Constraint::SliderJoint, "rod11", [169, 73, 15]),
    (Constraint::SliderJoint, "rod12", [211, 119, 37]),
    (Constraint::SliderJoint, "rod21", [246, 168, 2]),
    (Constraint::SliderJoint, "rod31", [249, 239, 46]),
    (Constraint::PlatformJoint, "rod11", [40, 58, 0]),
    (Constraint::PlatformJoint, "rod12", [8, 176, 155]),
    (Constraint::PlatformJoint, "rod21", [68, 222, 167]),
    (Constraint::PlatformJoint, "rod31", [162, 250, 254]),
    (Constraint::TableClearance, "tool", [118, 62, 96]),
];

/// The colour of a limit that bounds most workspaces.
fn own_colour(constraint: Constraint, element: &str) -> Option<[u8; 3]> {
    OWN.iter().find(|(kind, name, _)| *kind == constraint && *name == element).map(|(_, _, rgb)| *rgb)
}

/// The colour of the first of a constraint's other elements.
fn shared_colour(constraint: Constraint) -> [u8; 3] {
    match constraint {
        Constraint::RodInterference => [175, 104, 84],
        Constraint::Tilt => [71, 142, 137],
        Constraint::Rotary => [91, 76, 146],
        Constraint::LegLength => [137, 88, 100],
        Constraint::SerialSingularity => [56, 34, 46],
        Constraint::ParallelSingularity => [199, 222, 110],
        Constraint::RodCrossing => [172, 213, 237],
        Constraint::TableClearance => [203, 243, 190],
        // Their elements have colours of their own.
        Constraint::Stroke | Constraint::SliderJoint | Constraint::PlatformJoint => [120, 120, 120],
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a mean of two bytes is one")]
fn lighter(rgb: [u8; 3], white: f64) -> [u8; 3] {
    rgb.map(|channel| (f64::from(channel) * (1.0 - white) + 255.0 * white).round() as u8)
}

#[cfg(test)]
mod tests {
    use verne_solver::Constraint;

    use super::{OWN, shared_colour};

    type Matrix = [[f64; 3]; 3];

    /// Colours as people see them: with all cones, then without the red, green or blue ones. Linear sRGB to linear
    /// sRGB, from Machado, Oliveira and Fernandes 2009, DOI 10.1109/TVCG.2009.113, severity 1.
    const SIGHTS: [Matrix; 4] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [
            [0.152_286, 1.052_583, -0.204_868],
            [0.114_503, 0.786_281, 0.099_216],
            [-0.003_882, -0.048_116, 1.051_998],
        ],
        [
            [0.367_322, 0.860_646, -0.227_968],
            [0.280_085, 0.672_501, 0.047_413],
            [-0.011_820, 0.042_940, 0.968_881],
        ],
        [
            [1.255_528, -0.076_749, -0.178_779],
            [-0.078_411, 0.930_809, 0.147_602],
            [0.004_733, 0.691_367, 0.303_900],
        ],
    ];
    /// From linear sRGB to the responses of cones, and from their cube roots to Oklab
    /// (<https://bottosson.github.io/posts/oklab/>).
    const CONES: Matrix = [
        [0.412_221_470_8, 0.536_332_536_3, 0.051_445_992_9],
        [0.211_903_498_2, 0.680_699_545_1, 0.107_396_956_6],
        [0.088_302_461_9, 0.281_718_837_6, 0.629_978_700_5],
    ];
    const OKLAB: Matrix = [
        [0.210_454_255_3, 0.793_617_785_0, -0.004_072_046_8],
        [1.977_998_495_1, -2.428_592_205_0, 0.450_593_709_9],
        [0.025_904_037_1, 0.782_771_766_2, -0.808_675_766_0],
    ];

    fn product(matrix: &Matrix, vector: [f64; 3]) -> [f64; 3] {
        matrix.map(|row| row[0] * vector[0] + row[1] * vector[1] + row[2] * vector[2])
    }

    fn linear(channel: u8) -> f64 {
        let channel = f64::from(channel) / 255.0;
        if channel <= 0.04045 { channel / 12.92 } else { ((channel + 0.055) / 1.055).powf(2.4) }
    }

    fn seen(rgb: [u8; 3], sight: &Matrix) -> [f64; 3] {
        let light = product(sight, rgb.map(linear)).map(|channel| channel.clamp(0.0, 1.0));
        product(&OKLAB, product(&CONES, light).map(f64::cbrt))
    }

    /// The least distance of two colours for any of the sights, in Oklab: black and white have 1.
    fn distance(a: [u8; 3], b: [u8; 3]) -> f64 {
        let apart = |sight| {
            let [p, q] = [a, b].map(|rgb| seen(rgb, sight));
            p.iter().zip(q).map(|(u, v)| (u - v).powi(2)).sum::<f64>().sqrt()
        };
        SIGHTS.iter().map(apart).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn everybody_can_tell_the_colours_apart() {
        let own = OWN.map(|(_, _, rgb)| rgb);
        let others = Constraint::ALL
            .into_iter()
            .filter(|constraint| {
                OWN.iter().all(|(kind, ..)| kind != constraint || *kind == Constraint::TableClearance)
            })
            .map(shared_colour);
        let colours: Vec<_> = own.into_iter().chain(others).collect();
        for (i, &a) in colours.iter().enumerate() {
            for (j, &b) in colours.iter().enumerate().skip(i + 1) {
                let least = if j < own.len() { 0.11 } else { 0.065 };
                assert!(distance(a, b) > least, "{a:?} and {b:?} are {} apart", distance(a, b));
            }
        }
        assert!((distance([0, 0, 0], [255, 255, 255]) - 1.0).abs() < 1e-3);
    }
}
