//! The greatest speeds at the ends of consecutive segments. Speeds are squares of ds/dt.

use super::corner::Corner;
use super::segment::Segment;

/// The greatest speeds at both ends of a segment.
pub(super) type Ends = [f64; 2];

/// Pass against the direction of motion: the greatest speed at both ends of each segment at which the machine can still
/// slow down for all that follows. `last` is the greatest speed at the end of the last segment.
///
/// `corners[i]` is before segment i.
pub(super) fn backward<'a>(
    segments: impl DoubleEndedIterator<Item = (&'a Segment, &'a Corner)>,
    last: f64,
) -> Vec<Ends> {
    let mut greatest = last;
    let mut ends: Vec<Ends> = Vec::new();
    for (segment, corner) in segments.rev() {
        let end = greatest.min(segment.greatest);
        let (rate, _) = segment.acceleration(end, false);
        let start = (end + 2.0 * rate * segment.width).min(segment.greatest).min(corner.greatest[1]);
        ends.push([start, end]);
        let before = corner.ratio.map_or(f64::INFINITY, |ratio| start / ratio);
        greatest = before.min(corner.greatest[0]);
    }
    ends.reverse();
    ends
}

/// Step in the direction of motion: the speeds at both ends of a segment whose greatest ones are `most`, after a
/// segment that ended with the speed `before`.
pub(super) fn forward(segment: &Segment, corner: &Corner, before: f64, most: Ends) -> Ends {
    let start = corner.ratio.map_or(most[0], |ratio| (before * ratio).min(most[0]));
    let (rate, _) = segment.acceleration(start, true);
    [start, (start + 2.0 * rate * segment.width).min(most[1])]
}
