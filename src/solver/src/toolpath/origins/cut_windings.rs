//! The windings on which the rotary axis can follow a cut.

use std::f64::consts::{PI, TAU};

use crate::machine::Machine;
use crate::toolpath::planned_places::PlannedPlaces;

/// The number of windings of a cut on the planned preimage and on the other, up to 255 each. Without a range of the
/// rotary axis a plan uses one.
pub(super) type Windings = [u8; 2];

/// The windings of each cut that the range of the rotary axis admits.
pub(super) fn cut_windings(machine: &Machine, places: &PlannedPlaces) -> Vec<Windings> {
    let cuts = places.places.iter().map(|place| place.cut + 1).max().unwrap_or(0);
    let Some(range) = machine.limits().rotary else { return vec![[1; 2]; cuts] };
    let mut ends: Vec<Option<[f64; 2]>> = vec![None; cuts];
    for place in places.places.iter().filter(|place| !place.is_rapid) {
        let theta2 = -place.phi2;
        let [low, high] = ends[place.cut].unwrap_or([theta2; 2]);
        ends[place.cut] = Some([low.min(theta2), high.max(theta2)]);
    }
    let windings = |ends: Option<[f64; 2]>| {
        ends.map_or([1; 2], |ends| [0.0, PI].map(|turn| number(range, ends.map(|end| end + turn))))
    };
    ends.into_iter().map(windings).collect()
}

/// The number of whole turns that bring an interval into a range.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to the range of the type"
)]
fn number([low, high]: [f64; 2], [least, greatest]: [f64; 2]) -> u8 {
    let turns = ((high - greatest) / TAU).floor() - ((low - least) / TAU).ceil() + 1.0;
    turns.clamp(0.0, 255.0) as u8
}
