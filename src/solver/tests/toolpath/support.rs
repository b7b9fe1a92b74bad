//! Programs, and the check of rows by the forward problem.

use verne_solver::axis::tool_axis;
use verne_solver::toolpath::{
    AdjustableProgram, Curve, Motion, MotionKind, Motions, PlanOptions, Report, Row, SetUp, ToolPosition,
    Turning, plan,
};
use verne_solver::{Machine, TableAngles, forward_working, part_pose};

use super::random::Random;

/// A machine whose dimensions differ from those of the reference machine by up to a tenth.
pub(crate) fn any_machine(random: &mut Random) -> Machine {
    loop {
        let mut data = Machine::verne().data().clone();
        let g = &mut data.geometry;
        let lengths = [
            &mut g.D1, &mut g.d1, &mut g.D2, &mut g.d2, &mut g.R1, &mut g.r1, &mut g.R2, &mut g.r4,
            &mut g.L1, &mut g.L2, &mut g.L3,
        ];
        for length in lengths {
            *length *= random.between(0.9, 1.1);
        }
        data.table.dt += random.between(-30.0, 30.0);
        if let Ok(machine) = Machine::new(data) {
            return machine;
        }
    }
}

pub(crate) fn unit(v: [f64; 3]) -> [f64; 3] {
    let norm = v.iter().map(|c| c * c).sum::<f64>().sqrt();
    v.map(|c| c / norm)
}

pub(crate) fn motion(kind: MotionKind, tip: [f64; 3], axis: [f64; 3]) -> Motion {
    Motion {
        kind,
        end: ToolPosition { tip, axis: unit(axis) },
        curve: Curve::Line,
        turning: Turning::GreatCircle,
        tool_length: 100.0,
    }
}

pub(crate) fn arrive(tip: [f64; 3], axis: [f64; 3]) -> Motion {
    motion(MotionKind::Arrive, tip, axis)
}

pub(crate) fn feed(tip: [f64; 3], axis: [f64; 3]) -> Motion {
    motion(MotionKind::Feed, tip, axis)
}

pub(crate) fn rapid(tip: [f64; 3], axis: [f64; 3]) -> Motion {
    motion(MotionKind::Rapid, tip, axis)
}

pub(crate) fn planned(machine: &Machine, program: &[Motion], options: &PlanOptions) -> (Report, Vec<Row>) {
    let mut rows = Vec::new();
    let report = plan(machine, program, options, |_| true, |row| rows.push(*row)).unwrap();
    (report, rows)
}

/// Where the tool is on the exact path of a motion, sampled densely.
fn exact(start: &ToolPosition, motion: &Motion, s: f64) -> ToolPosition {
    let mix = |a: f64, b: f64| a + (b - a) * s;
    let tip = match motion.curve {
        Curve::Line => std::array::from_fn(|i| mix(start.tip[i], motion.end.tip[i])),
        Curve::Arc { centre, normal, sweep } => arc(start.tip, motion.end.tip, centre, normal, sweep, s),
    };
    let axis = match motion.turning {
        Turning::GreatCircle => slerp(start.axis, motion.end.axis, s),
        Turning::Angles { start, end, frame } => {
            let axis = tool_axis(mix(start[0], end[0]), mix(start[1], end[1]));
            frame.map(|row| (0..3).map(|i| row[i] * axis[i]).sum())
        }
        Turning::Held { start, end } => tool_axis(mix(start[0], end[0]), mix(start[1], end[1])),
    };
    ToolPosition { tip, axis }
}

/// Rodrigues' rotation of the start about the axis; the end's error is spread over the arc.
fn arc(a: [f64; 3], b: [f64; 3], centre: [f64; 3], n: [f64; 3], sweep: f64, s: f64) -> [f64; 3] {
    let turned = |angle: f64| {
        let v: [f64; 3] = std::array::from_fn(|i| a[i] - centre[i]);
        let along = n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
        let cross = [n[1] * v[2] - n[2] * v[1], n[2] * v[0] - n[0] * v[2], n[0] * v[1] - n[1] * v[0]];
        let (sin, cos) = angle.sin_cos();
        let turned: [f64; 3] =
            std::array::from_fn(|i| centre[i] + v[i] * cos + cross[i] * sin + n[i] * along * (1.0 - cos));
        turned
    };
    let (end, now) = (turned(sweep), turned(sweep * s));
    std::array::from_fn(|i| now[i] + (b[i] - end[i]) * s)
}

fn slerp(a: [f64; 3], b: [f64; 3], s: f64) -> [f64; 3] {
    let dot: f64 = (0..3).map(|i| a[i] * b[i]).sum();
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let angle = cross.iter().map(|c| c * c).sum::<f64>().sqrt().atan2(dot);
    if angle < 1e-12 {
        return a;
    }
    let (p, q) = (((1.0 - s) * angle).sin() / angle.sin(), (s * angle).sin() / angle.sin());
    unit(std::array::from_fn(|i| p * a[i] + q * b[i]))
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1]).hypot(a[2] - b[2])
}

/// The greatest deviation of the rows' linear joint motion from the program's feed paths, as a fraction of the
/// tolerance: at 20 places between rows, at the best of many path parameters.
pub(crate) fn worst_deviation(
    machine: &Machine,
    program: &[Motion],
    rows: &[Row],
    options: &PlanOptions,
) -> f64 {
    let mut worst: f64 = 0.0;
    for pair in rows.windows(2) {
        let [a, b] = [&pair[0], &pair[1]];
        if !b.kind.is_cut() || b.motion == 0 {
            continue;
        }
        let motion = &program[b.motion];
        let start = program[b.motion - 1].end;
        for place in 1..20 {
            let t = f64::from(place) / 20.0;
            let mix = |a: f64, b: f64| a + (b - a) * t;
            let rho = std::array::from_fn(|i| mix(a.rho[i], b.rho[i]));
            let table = TableAngles {
                theta1: mix(a.table.theta1, b.table.theta1),
                theta2: mix(a.table.theta2, b.table.theta2),
            };
            let pose = forward_working(machine, rho).unwrap().pose;
            let tool = part_pose(machine, &pose, table, motion.tool_length);
            let (tip, axis) = ([tool.x, tool.y, tool.z], tool_axis(tool.phi1, tool.phi2));
            worst = worst.max(best_fit(&start, motion, tip, axis, options));
        }
    }
    worst
}

fn best_fit(
    start: &ToolPosition,
    motion: &Motion,
    tip: [f64; 3],
    axis: [f64; 3],
    options: &PlanOptions,
) -> f64 {
    let miss = |s: f64| {
        let at = exact(start, motion, s);
        (distance(at.tip, tip) / options.tolerance.tip).max(distance(at.axis, axis) / options.tolerance.axis)
    };
    let count = 200;
    let best = (0..=count).min_by(|a, b| {
        let at = |i: &i32| miss(f64::from(*i) / f64::from(count));
        at(a).total_cmp(&at(b))
    });
    let middle = f64::from(best.unwrap()) / f64::from(count);
    let (mut low, mut high) =
        ((middle - 1.0 / f64::from(count)).max(0.0), (middle + 1.0 / f64::from(count)).min(1.0));
    for _ in 0..60 {
        let (c, d) = (low + 0.382 * (high - low), low + 0.618 * (high - low));
        if miss(c) < miss(d) { high = d } else { low = c }
    }
    miss(0.5 * (low + high))
}

/// A program in its own frame, which a set-up turns about z and moves.
pub(crate) struct Clamped(pub(crate) Vec<Motion>);

impl AdjustableProgram for Clamped {
    fn motions(&self, set_up: &SetUp) -> Box<dyn Motions + '_> {
        let (s, c) = set_up.turn.sin_cos();
        let turned = |[x, y, z]: [f64; 3]| [c * x - s * y, s * x + c * y, z];
        let moved = |p: [f64; 3]| {
            let turned = turned(p);
            std::array::from_fn(|i| set_up.origin[i] + turned[i])
        };
        let motions = self.0.iter().map(|motion| {
            let end = ToolPosition { tip: moved(motion.end.tip), axis: turned(motion.end.axis) };
            let curve = match motion.curve {
                Curve::Line => Curve::Line,
                Curve::Arc { centre, normal, sweep } => {
                    Curve::Arc { centre: moved(centre), normal: turned(normal), sweep }
                }
            };
            Motion { end, curve, tool_length: set_up.tool_length, ..*motion }
        });
        Box::new(motions.collect::<Vec<_>>())
    }

    fn is_adjusted(&self, _: usize) -> bool {
        true
    }

    fn stated(&self, set_up: &SetUp) -> SetUp {
        let rounded = |number: f64| (number * 1e7).round() / 1e7;
        SetUp::of_parameters(set_up.parameters().map(rounded))
    }
}
