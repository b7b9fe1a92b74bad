//! The time along one segment: the speed grows, stays, and falls.

use super::segment::Segment;
use super::times::Governor;

/// The times of the three phases, s, with what governs each.
pub(super) type Phases = [(f64, Governor); 3];

/// The shortest time along a segment between the speeds at its ends; speeds are squares of ds/dt.
pub(super) fn phases(segment: &Segment, [from, to]: [f64; 2]) -> Phases {
    let (up, up_governor) = segment.acceleration(from, true);
    let (down, down_governor) = segment.acceleration(to, false);
    let peak = peak(segment, [from, to], [up, down]);
    let grown = phase(from, peak, up);
    let fallen = phase(to, peak, down);
    let rest = (segment.width - grown.width - fallen.width).max(0.0);
    let steady = if peak > 0.0 { rest / peak.sqrt() } else { 0.0 };
    [(grown.time, up_governor), (steady, segment.governor), (fallen.time, down_governor)]
}

/// The greatest speed that is reached.
fn peak(segment: &Segment, [from, to]: [f64; 2], [up, down]: [f64; 2]) -> f64 {
    let met = if up.is_infinite() || down.is_infinite() {
        // One phase takes no way.
        let (low, rate) = if up.is_infinite() { (to, down) } else { (from, up) };
        low + 2.0 * rate * segment.width
    } else if up + down > 0.0 {
        (2.0 * segment.width * up * down + from * down + to * up) / (up + down)
    } else {
        0.0
    };
    met.min(segment.greatest).max(from).max(to)
}

struct Phase {
    width: f64,
    time: f64,
}

/// From the lower to the higher speed at a constant rate.
fn phase(low: f64, high: f64, rate: f64) -> Phase {
    if high <= low || rate.is_infinite() {
        return Phase { width: 0.0, time: 0.0 };
    }
    // The mean of both speeds covers the way; this is as accurate for small changes as for great ones.
    let width = (high - low) / (2.0 * rate);
    Phase { width, time: 2.0 * width / (high.sqrt() + low.sqrt()) }
}
