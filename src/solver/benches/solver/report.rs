//! The table, as Markdown.

use crate::candidates::FORWARD;
use crate::harness::Candidate;
use crate::root_finders::FINDERS;

/// Factor by which the forward problem should be faster than every general root finder.
const AHEAD: f64 = 5.0;

/// Prints one row per candidate, and the ratios of the general root finders.
pub(crate) fn print(candidates: &[Candidate<'_>], found: &[(&'static str, usize, usize)]) {
    println!("| | ns | ratio | target |");
    println!("|---|---:|---:|---:|");
    let baseline = &candidates[0];
    for candidate in candidates {
        let ratio = candidate.ratio_to(baseline);
        let target =
            candidate.target.map_or(String::new(), |most| format!("≤ {most}{}", missed(ratio > most)));
        println!("| {} | {:.0} | {ratio:.2} | {target} |", candidate.name, candidate.median());
    }
    let finders =
        candidates.iter().filter(|candidate| FINDERS.iter().any(|(name, _)| *name == candidate.name));
    let forward = candidates.iter().find(|candidate| candidate.name == FORWARD);
    let ahead = finders
        .zip(std::iter::repeat(forward))
        .filter_map(|(finder, forward)| Some(finder.ratio_to(forward?)));
    if let Some(least) = ahead.min_by(f64::total_cmp) {
        let target = missed(least < AHEAD);
        println!(
            "| the fastest root finder's time over that of FK, all assembly modes | | {least:.2} | ≥ {AHEAD}{target} |"
        );
    }
    println!();
    for (name, found, modes) in found {
        println!("- {name}: {found} of {modes} assembly modes found");
    }
}

/// The mark of a target that is not reached.
pub(crate) fn missed(missed: bool) -> &'static str {
    if missed { " (missed)" } else { "" }
}
