//! What a planned row costs in working inverse problems of the part frame, and how long a placement takes:
//! `cargo bench --bench toolpath`.
//!
//! Both are timed in turns of about the same length, so that other load on the machine slows both down. The target is at
//! most six.

use std::hint::black_box;
use std::time::Instant;

use verne_solver::axis::{Preimages, preimages};
use verne_solver::toolpath::{
    AdjustableProgram, Curve, Motion, MotionKind, Motions, PlacementRequest, PlanOptions, SetUp,
    ToolPosition, Turning, place, plan,
};
use verne_solver::workspace::Unobserved;
use verne_solver::{Constraint, Machine, PartPose, part_working};

const ROUNDS: usize = 21;
/// Inverse problems for each row, which is the target.
const SOLUTIONS: usize = 6;

/// A dome finished in a raster: `lines` lines of `points` points.
fn dome(lines: u32, points: u32) -> Vec<Motion> {
    let mut program = Vec::new();
    for line in 0..lines {
        for point in 0..points {
            let along = f64::from(point) / f64::from(points - 1);
            let along = if line % 2 == 0 { along } else { 1.0 - along };
            let [x, y] = [120.0 * along - 60.0, 120.0 * f64::from(line) / f64::from(lines) - 60.0];
            let radius = 200.0;
            let z = (radius * radius - x * x - y * y).sqrt();
            let axis = [x / radius, y / radius, z / radius];
            let kind = match (line, point) {
                (0, 0) => MotionKind::Arrive,
                (_, 0) => MotionKind::Rapid,
                _ => MotionKind::Feed,
            };
            program.push(Motion {
                kind,
                end: ToolPosition { tip: [x, y, z + 120.0], axis },
                curve: Curve::Line,
                turning: Turning::GreatCircle,
                tool_length: 100.0,
            });
        }
    }
    program
}

fn number(count: usize) -> f64 {
    f64::from(u32::try_from(count).unwrap_or(u32::MAX))
}

/// A dome in its own frame.
struct Clamped(Vec<Motion>);

impl AdjustableProgram for Clamped {
    fn motions(&self, set_up: &SetUp) -> Box<dyn Motions + '_> {
        let (s, c) = set_up.turn.sin_cos();
        let turned = |[x, y, z]: [f64; 3]| [c * x - s * y, s * x + c * y, z];
        let motions = self.0.iter().map(|motion| {
            let tip = turned(motion.end.tip);
            let tip = std::array::from_fn(|i| set_up.origin[i] + tip[i]);
            let end = ToolPosition { tip, axis: turned(motion.end.axis) };
            Motion { end, tool_length: set_up.tool_length, ..*motion }
        });
        Box::new(motions.collect::<Vec<_>>())
    }

    fn is_adjusted(&self, _: usize) -> bool {
        true
    }

    fn stated(&self, set_up: &SetUp) -> SetUp {
        *set_up
    }
}

/// Places a dome of 100,000 rows with all parameters free, from a set-up in which the machine can run it and from one in
/// which it cannot.
fn placements(machine: &Machine) {
    let program = Clamped(dome(200, 500));
    for origin in [[10.0, -20.0, 0.0], [150.0, 150.0, -260.0]] {
        let given = SetUp { origin, turn: 0.1, tool_length: 100.0 };
        let request = PlacementRequest {
            bounds: [[-200.0, 200.0], [-200.0, 200.0], [-280.0, 320.0], [-3.0, 3.0], [50.0, 200.0]],
            reserve: vec![(Constraint::Stroke, 20.0), (Constraint::SliderJoint, 0.035)],
        };
        let start = Instant::now();
        let placed = place(machine, &program, given, &request, &PlanOptions::default(), &Unobserved);
        let Ok(placed) = placed else { continue };
        let seconds = start.elapsed().as_secs_f64();
        let rows = placed.report.rows;
        println!("placement of {rows} rows: {seconds:.2} s, t from {:?} to {:?}", placed.given.0, placed.t);
    }
}

fn main() {
    let machine = Machine::verne();
    placements(&machine);
    for (lines, points) in [(100, 500), (2_000, 12)] {
        let program = dome(lines, points);
        let targets: Vec<PartPose> = program
            .iter()
            .filter_map(|motion| {
                let Preimages::Two([[phi1, phi2], _]) = preimages(motion.end.axis)? else { return None };
                let [x, y, z] = motion.end.tip;
                Some(PartPose { x, y, z, phi1, phi2 })
            })
            .collect();
        let mut ratios = Vec::new();
        let mut rows = 0_u64;
        let mut best = [f64::INFINITY; 2];
        for _ in 0..ROUNDS {
            let start = Instant::now();
            let options = PlanOptions::default();
            let report = plan(
                &machine,
                &program[..],
                &options,
                |_| true,
                |row| {
                    black_box(row);
                },
            );
            let Ok(report) = report else { continue };
            rows = report.rows;
            let row = start.elapsed().as_secs_f64() / number(usize::try_from(rows).unwrap_or_default());
            let passes = SOLUTIONS * usize::try_from(rows).unwrap_or_default() / targets.len();
            let start = Instant::now();
            for target in (0..passes).flat_map(|_| &targets) {
                let _ = black_box(part_working(&machine, black_box(target), 100.0));
            }
            let solve = start.elapsed().as_secs_f64() / number(passes * targets.len());
            println!("{} ns a solution, {} ns a row", solve * 1e9, row * 1e9);
            ratios.push(row / solve);
            best = [best[0].min(row), best[1].min(solve)];
        }
        ratios.sort_by(f64::total_cmp);
        println!(
            "{} motions, {rows} rows: {:.2} solutions a row, {:.2} in the best rounds",
            program.len(),
            ratios[ratios.len() / 2],
            best[0] / best[1]
        );
    }
}
