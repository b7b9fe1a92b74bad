//! G93, G94, G95 and F.

use crate::builder::ProgrammedFeed;
use crate::error::ProgramError;
use crate::gcode::block::Block;
use crate::gcode::codes::Codes;
use crate::gcode::state::State;
use crate::gcode::vocabulary::{FeedMode, Group, Meaning};
use crate::moves::{Feed, FeedUnit, MoveKind};

/// The largest feed, in its unit.
const LARGEST: f64 = 1e9;

/// Does what the feed mode and F of a block say.
pub(crate) fn apply(state: &mut State, block: &Block<'_>, codes: &Codes<'_, '_>) -> Result<(), ProgramError> {
    if let Some(Meaning::FeedMode(mode)) = codes.get(Group::FeedMode)
        && mode != state.feed_mode
    {
        state.feed_mode = mode;
        state.feed = ProgrammedFeed::default();
    }
    if state.feed_mode == FeedMode::InverseTime {
        // F holds for one block.
        state.feed = ProgrammedFeed::default();
    }
    let Some(word) = block.take(b'F') else { return Ok(()) };
    let millimetres =
        if state.feed_mode == FeedMode::InverseTime { 1.0 } else { state.millimetres(block.line) };
    let scaled = word.value * millimetres;
    if !(word.value > 0.0 && scaled <= LARGEST) {
        let detail = "a feed must be positive and at most 1000000000";
        return Err(block.fault_at(word, detail.to_owned()));
    }
    let of = |value: f64, unit: FeedUnit| Some(Feed { value, unit });
    state.feed = match state.feed_mode {
        FeedMode::InverseTime => {
            let feed = of(word.value, FeedUnit::InverseMinutes);
            ProgrammedFeed { travel: feed, turn: feed }
        }
        FeedMode::PerMinute => ProgrammedFeed {
            travel: of(scaled, FeedUnit::MillimetresPerMinute),
            // Angles are degrees in programs in inches, too.
            turn: of(word.value, FeedUnit::DegreesPerMinute),
        },
        FeedMode::PerRevolution => {
            ProgrammedFeed { travel: of(scaled, FeedUnit::MillimetresPerRevolution), turn: None }
        }
    };
    Ok(())
}

/// The kind of a move that the program calls a feed move: one that is as fast as `rapid_feed` is a rapid.
pub(crate) fn kind(state: &mut State, line: u32) -> MoveKind {
    let Some(feed) = state.feed.travel else {
        let detail = "a feed move without F: the drives decide";
        state.builder.diagnostics.warn(line, "", detail);
        return MoveKind::Feed;
    };
    let fast = state.builder.options.rapid_feed.is_some_and(|rapid| feed.value >= rapid);
    if fast && feed.unit == FeedUnit::MillimetresPerMinute { MoveKind::Rapid } else { MoveKind::Feed }
}
