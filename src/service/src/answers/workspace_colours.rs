//! Colours for what limits a workspace.

use std::collections::BTreeMap;

use verne_mesh::Swatch;
use verne_solver::Constraint;
use verne_solver::workspace::Binding;

use crate::wire::limit::{ConstraintName, ElementName};

/// The share of white that each further element of a constraint has in its colour, and its most.
const LIGHTER: [f64; 2] = [0.18, 0.6];

/// A tag for each triangle, and what the tags mean: `stroke slider1.max`. Only what occurs has one, in a fixed order.
pub(super) fn coloured(bindings: &[Binding]) -> (Vec<u8>, Vec<Swatch>) {
    let mut names = BTreeMap::new();
    for &binding in bindings {
        names.entry(key(binding)).or_insert(0_u8);
    }
    let mut palette = Vec::with_capacity(names.len());
    let mut before: Option<Constraint> = None;
    let mut step = 0.0;
    for (tag, ((constraint, element), number)) in (0..).zip(&mut names) {
        *number = tag;
        step = if before == Some(*constraint) { step + 1.0 } else { 0.0 };
        before = Some(*constraint);
        let name = format!("{} {element}", ConstraintName::from(*constraint));
        palette.push(Swatch { name, rgb: lighter(colour(*constraint), step) });
    }
    // A surface has long runs of one binding.
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

/// Hues that colour-blind people can tell apart (Okabe and Ito's), darker ones for what seldom limits.
fn colour(constraint: Constraint) -> [u8; 3] {
    match constraint {
        Constraint::Stroke => [0, 114, 178],
        Constraint::SliderJoint => [230, 159, 0],
        Constraint::PlatformJoint => [0, 158, 115],
        Constraint::RodInterference => [204, 121, 167],
        Constraint::Tilt => [213, 94, 0],
        Constraint::Rotary => [240, 228, 66],
        Constraint::LegLength => [120, 120, 120],
        Constraint::SerialSingularity => [70, 70, 70],
        Constraint::ParallelSingularity => [136, 34, 85],
        Constraint::RodCrossing => [51, 34, 136],
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a mean of two bytes is one")]
fn lighter(rgb: [u8; 3], step: f64) -> [u8; 3] {
    let white = (step * LIGHTER[0]).min(LIGHTER[1]);
    rgb.map(|channel| (f64::from(channel) * (1.0 - white) + 255.0 * white).round() as u8)
}
