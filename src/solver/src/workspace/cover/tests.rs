//! The bounds over a box compared with values at its points.

use super::super::domain::{Domain, LIMITS};
use super::super::request::{Kind, Request};
use super::Rectangle;
use super::judgement::{Judgement, OTHERS, all_limits, judged, parallelograms_apart};
use crate::machine::Machine;

/// Pseudo-random numbers: xorshift.
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        low + (high - low) * ((self.0 >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// Any machine, its dimensions up to e^`spread` times the reference machine's.
    fn machine(&mut self, spread: f64) -> Option<Machine> {
        let mut data = Machine::verne().data().clone();
        let g = &mut data.geometry;
        let lengths = [
            &mut g.D1,
            &mut g.d1,
            &mut g.D2,
            &mut g.d2,
            &mut g.R1,
            &mut g.r1,
            &mut g.R2,
            &mut g.r4,
            &mut g.L1,
            &mut g.L2,
            &mut g.L3,
            &mut g.parallelogram_half_width,
        ];
        for length in lengths {
            *length *= self.between(-spread, spread).exp();
        }
        g.rod_radius = self.between(0.0, 90.0);
        let l = &mut data.limits;
        for stroke in &mut l.stroke {
            stroke[1] *= self.between(-spread, spread).exp();
        }
        (l.slider_cone, l.platform_cone) = (self.between(0.5, 3.1), self.between(0.5, 3.1));
        l.serial_margin = self.between(-0.1, 0.4).max(0.0);
        let low = self.between(-0.5, 0.4);
        l.tilt = [low, low + self.between(0.05, 6.0)];
        Machine::new(data).ok()
    }
}

/// Every limit's values at points of a box lie within its bounds, and rise or fall as the bounds say.
#[test]
fn bounds_hold() {
    let mut numbers = Random(0x2545_f491_4f6c_dd1d);
    let (mut inside, mut simple, mut outside) = (0, 0, 0);
    for _ in 0..3_000 {
        let spread = numbers.between(0.1, 1.4);
        let Some(machine) = numbers.machine(spread) else { continue };
        let kind = [Kind::Platform, Kind::Part][usize::from(numbers.between(0.0, 1.0) < 0.5)];
        let request = Request {
            kind,
            tool_length: 50.0,
            phi1: numbers.between(-3.0, 3.0),
            phi2: 0.0,
            table_clearance: (numbers.between(0.0, 1.0) < 0.5).then(|| numbers.between(-500.0, 500.0)),
            tool_radius: 5.0,
            tolerance: 1.0,
        };
        let height = (numbers.between(0.0, 1.0) < 0.3).then(|| numbers.between(-500.0, 2_000.0));
        let domain = Domain::new(&machine, &request, height);
        let Some([low, high]) = parallelograms_apart(&domain) else { continue };
        for _ in 0..150 {
            let size = numbers.between(-9.0, -1.0).exp() * (high[0] - low[0]).max(high[1] - low[1]);
            let at = [0, 1].map(|axis| numbers.between(low[axis], high[axis]));
            let mut place = [[0, 1].map(|i| at[i] - size), [0, 1].map(|i| at[i] + size)];
            for i in 0..2 {
                (place[0][i], place[1][i]) = (place[0][i].max(low[i]), place[1][i].min(high[i]));
            }
            if at[1] < 0.0 {
                place[1][1] = place[1][1].min(0.0);
            } else {
                place[0][1] = place[0][1].max(0.0);
            }
            match judged(&domain, place, all_limits(&domain)) {
                Judgement::Inside => {
                    inside += 1;
                    points(&mut numbers, place, |at| {
                        let values = domain.values(&domain.column(at));
                        assert!(
                            values.iter().all(|value| *value >= -1e-9),
                            "{place:?} {values:?} {machine:?}"
                        );
                    });
                }
                Judgement::Outside => {
                    outside += 1;
                    points(&mut numbers, place, |at| {
                        let values = domain.values(&domain.column(at));
                        assert!(values.iter().any(|value| *value < 1e-9), "{place:?} {values:?} {machine:?}");
                    });
                }
                Judgement::Crossed { limits, simple: true, .. } => {
                    simple += 1;
                    column_is_one(&mut numbers, &domain, place, limits);
                }
                Judgement::Crossed { .. } => {}
            }
        }
    }
    assert!(inside > 10_000 && simple > 1_500 && outside > 100_000, "{inside} {simple} {outside}");
}

fn points(numbers: &mut Random, [low, high]: Rectangle, mut look: impl FnMut([f64; 2])) {
    for _ in 0..12 {
        look([0, 1].map(|axis| numbers.between(low[axis], high[axis])));
    }
    for x in [low[0], high[0]] {
        look([x, low[1]]);
        look([x, high[1]]);
    }
}

/// The points of a line x = const that keep every limit are contiguous, and every limit that the cover proves is
/// kept.
fn column_is_one(numbers: &mut Random, domain: &Domain<'_>, [low, high]: Rectangle, limits: u32) {
    let x = numbers.between(low[0], high[0]);
    let mut changes = 0;
    let mut before = false;
    for step in 0..=40 {
        let y = low[1] + (high[1] - low[1]) * f64::from(step) / 40.0;
        let values = domain.values(&domain.column([x, y]));
        let kept = |limit: usize| limits & (1 << limit) != 0 || limit < OTHERS || values[limit] >= -1e-9;
        let member = values.iter().all(|value| *value >= 0.0);
        if (0..OTHERS).all(|limit| values[limit] >= 0.0) {
            let legs = (4..6).all(|limit| values[limit] >= 0.0);
            assert!(!legs || (0..LIMITS).all(kept), "{:?} {values:?} {limits:b} {domain:?}", [x, y]);
        }
        changes += usize::from(member && !before);
        before = member;
    }
    assert!(changes <= 1, "{x:?} {low:?} {high:?} {limits:b} {domain:?}");
}
