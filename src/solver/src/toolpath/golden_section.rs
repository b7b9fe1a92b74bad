//! The place of a least value, by golden section.

/// Steps that shrink the interval to 6e-6 of its width.
pub(super) const STEPS: u32 = 25;
const GOLDEN: f64 = 0.618_033_988_749_894_8;

/// Where `value` is least between two parameters, if it has one minimum there. It is examined inside them only, and the
/// answer is the place with the least of the examined values.
pub(super) fn least([mut low, mut high]: [f64; 2], steps: u32, mut value: impl FnMut(f64) -> f64) -> f64 {
    let inner = |low: f64, high: f64| [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let [mut a, mut b] = inner(low, high);
    let [mut at_a, mut at_b] = [value(a), value(b)];
    for _ in 0..steps {
        if at_a < at_b {
            (high, b, at_b) = (b, a, at_a);
            a = inner(low, high)[0];
            at_a = value(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = inner(low, high)[1];
            at_b = value(b);
        }
    }
    if at_a < at_b { a } else { b }
}

/// The parameters of the places beside one of `intervals + 1` places from 0 to 1.
pub(super) fn beside(place: u32, intervals: u32) -> [f64; 2] {
    let [low, high] = [place.saturating_sub(1), (place + 1).min(intervals)];
    [low, high].map(|place| f64::from(place) / f64::from(intervals))
}
