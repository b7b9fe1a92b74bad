//! Whether an origin belongs to the region.

use std::collections::BTreeMap;

use crate::machine::Machine;
use crate::pose::Point;
use crate::toolpath::placement::{Criteria, cut_margin};
use crate::toolpath::planned_places::PlannedPlaces;
use crate::toolpath::set_up::SetUp;

/// Places that are examined together.
const BLOCK: usize = 32;

/// Whether the range of the rotary axis admits each cut on the planned preimage and on the other.
pub(super) fn admitted_cuts(machine: &Machine, places: &PlannedPlaces) -> Vec<[bool; 2]> {
    let cuts = places.places.iter().map(|place| place.cut + 1).max().unwrap_or(0);
    let Some(range) = machine.limits().rotary else { return vec![[true; 2]; cuts] };
    let mut ends: Vec<Option<[f64; 2]>> = vec![None; cuts];
    for place in &places.places {
        let theta2 = -place.phi2;
        let [low, high] = ends[place.cut].unwrap_or([theta2; 2]);
        ends[place.cut] = Some([low.min(theta2), high.max(theta2)]);
    }
    let admitted = |ends: Option<[f64; 2]>| {
        let Some([low, high]) = ends else { return [true; 2] };
        let cut = [0.5 * (low + high), 0.5 * (high - low)];
        [false, true].map(|other| cut_margin(range, cut, other) >= 0.0)
    };
    ends.into_iter().map(admitted).collect()
}

/// Examines origins with some places of a program.
pub(super) struct Membership<'a> {
    machine: &'a Machine,
    places: &'a PlannedPlaces,
    set: &'a [u32],
    admitted: &'a [[bool; 2]],
    /// The places of each cut.
    cuts: BTreeMap<usize, Vec<u32>>,
    criteria: Criteria,
}

impl<'a> Membership<'a> {
    pub(super) fn new(
        machine: &'a Machine,
        places: &'a PlannedPlaces,
        set: &'a [u32],
        admitted: &'a [[bool; 2]],
    ) -> Self {
        let mut cuts: BTreeMap<usize, Vec<u32>> = BTreeMap::new();
        for place in set {
            cuts.entry(places.places[*place as usize].cut).or_default().push(*place);
        }
        Self { machine, places, set, admitted, cuts, criteria: Criteria::new(machine, &[]) }
    }

    /// Whether every cut keeps the limits on one of its preimages. `hint` is the block of places that is examined
    /// first: the one that has excluded an origin nearby.
    pub(super) fn contains(&self, origin: Point, hint: &mut usize) -> bool {
        if self.admitted.contains(&[false; 2]) {
            return false;
        }
        let set_up = SetUp { origin, ..self.places.set_up };
        let blocks = self.set.len().div_ceil(BLOCK);
        // The cuts that are on the other preimage.
        let mut changed: Vec<usize> = Vec::new();
        for number in 0..blocks {
            let block = (number + *hint) % blocks;
            let places = &self.set[block * BLOCK..((block + 1) * BLOCK).min(self.set.len())];
            let mut failing: Vec<usize> = Vec::new();
            self.places.margins(self.machine, places, (&set_up, false), |i, margins| {
                let cut = self.places.places[places[i] as usize].cut;
                let holds = self.admitted[cut][0]
                    && self.criteria.values(self.machine, margins).iter().all(|value| *value >= 0.0);
                if !holds && failing.last() != Some(&cut) {
                    failing.push(cut);
                }
            });
            for cut in failing {
                if changed.contains(&cut) {
                    continue;
                }
                if !self.holds_on_other(cut, &set_up) {
                    *hint = block;
                    return false;
                }
                changed.push(cut);
            }
        }
        true
    }

    /// Whether a cut keeps the limits on its other preimage.
    fn holds_on_other(&self, cut: usize, set_up: &SetUp) -> bool {
        let Some(places) = self.cuts.get(&cut).filter(|_| self.admitted[cut][1]) else { return false };
        for block in places.chunks(BLOCK) {
            let mut holds = true;
            self.places.margins(self.machine, block, (set_up, true), |_, margins| {
                holds &= self.criteria.values(self.machine, margins).iter().all(|value| *value >= 0.0);
            });
            if !holds {
                return false;
            }
        }
        true
    }
}
