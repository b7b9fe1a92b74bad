//! Colours of the constraints that bound a workspace.

use std::collections::BTreeMap;

use verne_mesh::Swatch;
use verne_solver::Constraint;
use verne_solver::workspace::Binding;

use crate::wire::constraint::{ConstraintName, ElementName};

/// The share of white in the colour of a constraint's last element; the first has none.
const LIGHTEST: f64 = 0.7;

/// A tag for each triangle, and the names and colours of the tags, such as `stroke slider1.max`. Only constraints that
/// occur have a tag; their order is fixed.
pub(crate) fn tags_and_palette(bindings: &[Binding]) -> (Vec<u8>, Vec<Swatch>) {
    let mut names = BTreeMap::new();
    // A surface has long runs of one binding.
    for run in bindings.chunk_by(|a, b| a == b) {
        names.extend(run.first().map(|&binding| (key(binding), 0_u8)));
    }
    let mut elements = BTreeMap::new();
    for (constraint, _) in names.keys() {
        *elements.entry(*constraint).or_insert(0_u8) += 1;
    }
    let mut palette = Vec::with_capacity(names.len());
    let mut seen = BTreeMap::new();
    for (tag, ((constraint, element), number)) in (0..).zip(&mut names) {
        *number = tag;
        let step = seen.entry(*constraint).or_insert(0_u8);
        let steps = elements.get(constraint).map_or(1, |count| count.saturating_sub(1).max(1));
        let white = LIGHTEST * f64::from(*step) / f64::from(steps);
        *step += 1;
        let name = format!("{} {element}", ConstraintName(*constraint));
        palette.push(Swatch { name, rgb: lighter(colour(*constraint), white) });
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

/// The colour of a constraint. Colour-blind people can tell the hues apart (nearly those of Okabe and Ito); constraints
/// that seldom bound a workspace have darker ones.
fn colour(constraint: Constraint) -> [u8; 3] {
    match constraint {
        Constraint::Stroke => [0, 90, 158],
        Constraint::SliderJoint => [222, 143, 5],
        Constraint::PlatformJoint => [0, 158, 115],
        Constraint::RodInterference => [204, 121, 167],
        Constraint::Tilt => [213, 94, 0],
        Constraint::Rotary => [240, 228, 66],
        Constraint::TableClearance => [122, 72, 40],
        Constraint::LegLength => [120, 120, 120],
        Constraint::SerialSingularity => [70, 70, 70],
        Constraint::ParallelSingularity => [136, 34, 85],
        Constraint::RodCrossing => [51, 34, 136],
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a mean of two bytes is one")]
fn lighter(rgb: [u8; 3], white: f64) -> [u8; 3] {
    rgb.map(|channel| (f64::from(channel) * (1.0 - white) + 255.0 * white).round() as u8)
}
