//! Whether an origin belongs to the region.

use std::collections::{BTreeMap, BTreeSet};

use super::cut_windings::Windings;
use crate::machine::Machine;
use crate::pose::Point;
use crate::toolpath::placement::Criteria;
use crate::toolpath::planned_places::PlannedPlaces;
use crate::toolpath::set_up::SetUp;

/// Places that are examined together.
const BLOCK: usize = 32;

/// Examines origins with some places of a program.
///
/// An origin belongs to the region if every cut keeps the limits on a preimage and a winding such that each rapid
/// between two cuts is possible. A rapid on which both stay follows its line, which is examined. A rapid on which
/// either changes moves the joints straight: its ends alone are examined.
pub(super) struct Membership<'a> {
    machine: &'a Machine,
    places: &'a PlannedPlaces,
    set: &'a [u32],
    windings: &'a [Windings],
    /// The places of each cut, and of the rapid to it.
    cuts: BTreeMap<usize, [Vec<u32>; 2]>,
    criteria: Criteria,
}

/// The cuts that the planned preimage does not serve, all of which the other one serves, and those to which it has no
/// rapid along the line.
#[derive(Default)]
struct Unserved {
    cuts: BTreeSet<usize>,
    rapids: BTreeSet<usize>,
}

impl<'a> Membership<'a> {
    pub(super) fn new(
        machine: &'a Machine,
        places: &'a PlannedPlaces,
        set: &'a [u32],
        windings: &'a [Windings],
    ) -> Self {
        let mut cuts: BTreeMap<usize, [Vec<u32>; 2]> = BTreeMap::new();
        for place in set {
            let at = &places.places[*place as usize];
            cuts.entry(at.cut).or_default()[usize::from(at.is_rapid)].push(*place);
        }
        Self { machine, places, set, windings, cuts, criteria: Criteria::new(machine, &[]) }
    }

    /// Whether an origin belongs to the region. `hint` is the block of places that is examined first: the one that
    /// has excluded an origin nearby.
    pub(super) fn contains(&self, origin: Point, hint: &mut usize) -> bool {
        if self.windings.contains(&[0; 2]) {
            return false;
        }
        let set_up = SetUp { origin, ..self.places.set_up };
        let blocks = self.set.len().div_ceil(BLOCK);
        let mut unserved = Unserved::default();
        for number in 0..blocks {
            let block = (number + *hint) % blocks;
            let places = &self.set[block * BLOCK..((block + 1) * BLOCK).min(self.set.len())];
            let mut cuts = BTreeSet::new();
            self.places.margins(self.machine, places, (&set_up, false), |i, margins| {
                let place = &self.places.places[places[i] as usize];
                let holds = self.criteria.values(self.machine, margins).iter().all(|value| *value >= 0.0);
                if !holds && place.is_rapid {
                    unserved.rapids.insert(place.cut);
                } else if !holds || self.windings[place.cut][0] == 0 {
                    cuts.insert(place.cut);
                }
            });
            for cut in cuts {
                if unserved.cuts.contains(&cut) {
                    continue;
                }
                if !self.other_serves(cut, &set_up) {
                    *hint = block;
                    return false;
                }
                unserved.cuts.insert(cut);
            }
        }
        self.has_rapids(&unserved, &set_up)
    }

    /// Whether some preimages that serve the cuts have rapids between them.
    ///
    /// A cut needs the other preimage only if the planned one does not serve it, or has no rapid to or from it: a
    /// change of the preimage is always possible.
    fn has_rapids(&self, unserved: &Unserved, set_up: &SetUp) -> bool {
        if unserved.rapids.is_empty() && unserved.cuts.len() < 2 {
            return true;
        }
        // On which preimages the cut before can be reached.
        let (mut before, mut next) = ([true; 2], 0);
        for cut in self.cuts.keys().copied() {
            let is_unserved = unserved.cuts.contains(&cut);
            let needs_other =
                is_unserved || unserved.rapids.contains(&cut) || unserved.rapids.contains(&(cut + 1));
            // No limit is near in the cuts between.
            let is_free = cut != std::mem::replace(&mut next, cut + 1);
            let mut reached = [false; 2];
            for other in [false, true] {
                let serves = if other {
                    is_unserved || needs_other && self.other_serves(cut, set_up)
                } else {
                    !is_unserved
                };
                let [same, changed] = [before[usize::from(other)], before[usize::from(!other)]];
                reached[usize::from(other)] = serves
                    && (is_free
                        || changed
                        || same
                            && (self.has_windings(cut, other)
                                || self.has_line(cut, other, unserved, set_up)));
            }
            if reached == [false; 2] {
                return false;
            }
            before = reached;
        }
        true
    }

    /// Whether the winding can change on the rapid to a cut while the preimage stays.
    fn has_windings(&self, cut: usize, other: bool) -> bool {
        let windings = |cut: usize| self.windings[cut][usize::from(other)];
        windings(cut) > 1 || cut > 0 && windings(cut - 1) > 1
    }

    /// Whether the rapid to a cut can follow its line.
    fn has_line(&self, cut: usize, other: bool, unserved: &Unserved, set_up: &SetUp) -> bool {
        if other {
            self.cuts.get(&cut).is_none_or(|[_, rapid]| self.holds_on_other(rapid, set_up))
        } else {
            !unserved.rapids.contains(&cut)
        }
    }

    /// Whether a cut keeps the limits on its other preimage.
    fn other_serves(&self, cut: usize, set_up: &SetUp) -> bool {
        let admits = self.windings[cut][1] > 0;
        admits && self.cuts.get(&cut).is_some_and(|[places, _]| self.holds_on_other(places, set_up))
    }

    fn holds_on_other(&self, places: &[u32], set_up: &SetUp) -> bool {
        places.chunks(BLOCK).all(|block| {
            let mut holds = true;
            self.places.margins(self.machine, block, (set_up, true), |_, margins| {
                holds &= self.criteria.values(self.machine, margins).iter().all(|value| *value >= 0.0);
            });
            holds
        })
    }
}
