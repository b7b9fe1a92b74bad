//! Counts and coordinates against the brute-force oracle, on thousands of random questions.

use verne_solver::{Machine, Postures, Refusal, forward, part, platform, tool};

use crate::machines::{Draw, scale};
use crate::oracle::{self, Answer, Path, Tally, agree};

/// The postures of an answer, none where the question is refused for being out of reach.
fn postures(answer: Result<Postures, Refusal>) -> Postures {
    match answer {
        Ok(postures) => {
            assert!(!postures.is_empty(), "an empty answer is a refusal");
            postures
        }
        Err(Refusal::Blocked(margin)) => {
            assert!(margin.value < 0.0, "{margin:?}");
            Postures::new()
        }
        Err(other) => panic!("refused: {other:?}"),
    }
}

/// Compares many questions and lists the first disagreements.
struct Bench {
    tally: Tally,
    failures: Vec<String>,
}

impl Bench {
    fn new() -> Self {
        Self { tally: Tally::default(), failures: Vec::new() }
    }

    fn compare(
        &mut self,
        question: &str,
        machine: &Machine,
        answer: &Answer,
        got: Result<Postures, Refusal>,
    ) {
        assert!(!answer.continuum, "{question}");
        let got = postures(got);
        for posture in &got {
            let digits = 4.0 * f64::EPSILON * (posture.pose.z.abs() + scale(machine));
            let allowed = 9e-13 * scale(machine) + digits;
            if posture.residual.is_nan() || posture.residual > allowed {
                self.failures.push(format!("{question}: residual {posture:?}"));
            }
        }
        if let Err(difference) = agree(machine, answer, &got, &mut self.tally) {
            self.failures.push(format!("{question}: {difference}"));
        }
    }

    /// No disagreement; few lenient comparisons; solutions enough for the test to mean something.
    fn conclude(&self, most: usize) {
        let count = self.failures.len();
        assert_eq!(count, 0, "of {:?}; the first:\n{}", self.tally, self.failures[..count.min(3)].join("\n"));
        assert!(self.tally.lenient * 200 <= self.tally.compared, "{:?}", self.tally);
        assert!(self.tally.solutions > 2 * self.tally.compared, "{:?}", self.tally);
        assert!(self.tally.empty > 0 && self.tally.most >= most, "{:?}", self.tally);
    }
}

#[test]
fn assembly_modes_of_the_reference_machine() {
    let (machine, mut draw, mut bench) = (Machine::verne(), Draw::seeded(11), Bench::new());
    for _ in 0..3000 {
        let rho = draw.rho(&machine);
        let question = format!("rho {rho:?}");
        bench.compare(&question, &machine, &oracle::forward(&machine, rho), forward(&machine, rho));
    }
    bench.conclude(6);
}

#[test]
fn assembly_modes_within_the_strokes() {
    let (machine, mut draw, mut bench) = (Machine::verne(), Draw::seeded(12), Bench::new());
    for _ in 0..2000 {
        let rho = [0, 1, 2].map(|i| {
            let [low, high] = machine.data().limits.stroke[i];
            draw.between(low, high)
        });
        let question = format!("rho {rho:?}");
        bench.compare(&question, &machine, &oracle::forward(&machine, rho), forward(&machine, rho));
    }
    assert_eq!(bench.tally.empty, 0);
    bench.tally.empty = 1;
    bench.conclude(4);
}

#[test]
fn assembly_modes_of_random_machines() {
    let (mut draw, mut bench) = (Draw::seeded(13), Bench::new());
    for _ in 0..5000 {
        let machine = draw.machine();
        let rho = draw.rho(&machine);
        let question = format!("rho {rho:?}");
        bench.compare(&question, &machine, &oracle::forward(&machine, rho), forward(&machine, rho));
    }
    bench.conclude(8);
}

#[test]
fn postures_at_platform_positions() {
    let (mut draw, mut bench) = (Draw::seeded(14), Bench::new());
    for _ in 0..5000 {
        let machine = draw.any_machine();
        let p = draw.point(&machine);
        let answer = oracle::inverse(&machine, &Path::platform(p));
        bench.compare(&format!("p {p:?}"), &machine, &answer, platform(&machine, p));
    }
    bench.conclude(16);
}

#[test]
fn postures_at_tool_positions() {
    let (mut draw, mut bench) = (Draw::seeded(15), Bench::new());
    for _ in 0..5000 {
        let machine = draw.any_machine();
        let (u, tool_length) = (draw.point(&machine), draw.tool_length(&machine));
        let answer = oracle::inverse(&machine, &Path::tool(u, tool_length));
        let question = format!("u {u:?} tool {tool_length:?}");
        bench.compare(&question, &machine, &answer, tool(&machine, u, tool_length));
    }
    bench.conclude(16);
}

#[test]
fn postures_at_part_poses() {
    let (mut draw, mut bench) = (Draw::seeded(16), Bench::new());
    for _ in 0..5000 {
        let machine = draw.any_machine();
        let tool_length = draw.tool_length(&machine);
        let target = draw.part_pose(&machine, tool_length);
        let answer = oracle::inverse(&machine, &Path::part(&machine, &target, tool_length));
        let question = format!("{target:?} tool {tool_length:?}");
        bench.compare(&question, &machine, &answer, part(&machine, &target, tool_length));
    }
    bench.conclude(24);
}
