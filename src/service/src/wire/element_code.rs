//! A number for each part of the machine, for columns that name one in each row.

use verne_solver::{Constraint, Element};

use crate::wire::constraint::ElementName;

/// The rods.
const RODS: [u8; 6] = [11, 12, 21, 22, 31, 32];

/// The parts of the machine that a margin can belong to, each with a constraint that has it. The code of a part is its
/// position.
fn parts() -> Vec<(Constraint, Element)> {
    let mut parts = Vec::new();
    for slider in 1..=3 {
        parts.extend([false, true].map(|high| (Constraint::Stroke, Element::Stroke { slider, high })));
    }
    parts.extend((1..=3).map(|leg| (Constraint::LegLength, Element::Leg(leg))));
    parts.extend(RODS.map(|rod| (Constraint::SliderJoint, Element::Rod(rod))));
    parts.extend(RODS.map(|rod| (Constraint::TableClearance, Element::Joint(rod))));
    for constraint in [Constraint::Tilt, Constraint::Rotary] {
        parts.extend([false, true].map(|high| (constraint, Element::Range { high })));
    }
    parts.push((Constraint::ParallelSingularity, Element::Platform));
    parts.push((Constraint::TableClearance, Element::Tool));
    for (i, one) in RODS.into_iter().enumerate() {
        let others = RODS.iter().skip(i + 1);
        parts.extend(others.map(|other| (Constraint::RodInterference, Element::Rods(one, *other))));
    }
    parts
}

impl ElementName {
    /// The names of all parts, in the order of [`code`](Self::code).
    pub(crate) fn all() -> Vec<String> {
        let names = parts().into_iter().map(|(constraint, element)| Self { constraint, element });
        names.map(|name| name.to_string()).collect()
    }

    /// The position among all parts; `None` for a part that no machine has.
    pub(crate) fn code(self) -> Option<usize> {
        let rod = |rod| RODS.iter().position(|known| *known == rod);
        Some(match self.element {
            Element::Stroke { slider, high } => usize::from(2 * slider.checked_sub(1)?) + usize::from(high),
            Element::Leg(leg) => 6 + usize::from(leg.checked_sub(1)?),
            Element::Rod(number) => 9 + rod(number)?,
            Element::Joint(number) => 15 + rod(number)?,
            Element::Range { high } => {
                21 + 2 * usize::from(self.constraint == Constraint::Rotary) + usize::from(high)
            }
            Element::Platform => 25,
            Element::Tool => 26,
            Element::Rods(one, other) => {
                let (one, other) = (rod(one)?, rod(other)?);
                let (low, high) = (one.min(other), one.max(other));
                // The pairs before those of `low`, and those of `low` before `high`.
                27 + low * (2 * RODS.len() - low - 1) / 2 + high.checked_sub(low + 1)?
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{ElementName, parts};

    #[test]
    fn the_code_of_a_part_is_the_position_of_its_name() {
        let names = ElementName::all();
        assert!(names.len() <= 128);
        for (i, (constraint, element)) in parts().into_iter().enumerate() {
            let part = ElementName { constraint, element };
            assert_eq!(part.code(), Some(i), "{part}");
            assert_eq!(names.iter().position(|name| *name == part.to_string()), Some(i));
        }
    }
}
