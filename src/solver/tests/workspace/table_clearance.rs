//! The table as a limit of workspaces, compared with columns, slices and the margins.

use std::f64::consts::FRAC_PI_2;

use verne_solver::workspace::{
    Kind, Request, Surface, Unobserved, Volume, contains, measure, slice, surface,
};
use verne_solver::{
    Clearance, Constraint, Machine, Margins, PartPose, part_working, platform_working, table_angles,
};

use crate::column_lattice;
use crate::machines::{changed, others, random};
use crate::random::Random;
use crate::requests::{above, request};
use crate::table_clearance_margin::height;
use crate::topology::Topology;

fn volume(machine: &Machine, request: &Request) -> [f64; 2] {
    match measure(machine, request, &Unobserved).unwrap().volume {
        Volume::Value { value, error } => [value, error],
        Volume::Folded => panic!("folded"),
    }
}

/// Machines and requests whose workspaces the table cuts, including tilts beyond a quarter turn.
fn cut_ones() -> Vec<(Machine, Request)> {
    let tilting = |machine: &Machine| {
        let mut data = machine.data().clone();
        data.limits.tilt = [-3.0, 3.0];
        Machine::new(data).unwrap()
    };
    let mut machines: Vec<Machine> = others().into_iter().map(|(_, machine)| machine).collect();
    machines.push(Machine::verne());
    let mut all = Vec::new();
    for (n, machine) in (0_i32..).zip(machines) {
        let sign = if n % 2 == 0 { 1.0 } else { -1.0 };
        all.push((machine.clone(), above(0.0, 0.0, request(Kind::Part, 400.0, 0.0, 2.0))));
        all.push((machine.clone(), above(150.0, 60.0, request(Kind::Part, 300.0, 35.0 * sign, 2.0))));
        all.push((tilting(&machine), above(50.0, 30.0, request(Kind::Part, 100.0, 80.0 * sign, 2.0))));
        all.push((tilting(&machine), above(0.0, 0.0, request(Kind::Part, 50.0, 100.0 * sign, 2.0))));
        all.push((tilting(&machine), above(20.0, 0.0, request(Kind::Part, 50.0, 125.0 * sign, 2.0))));
        all.push((tilting(&machine), above(20.0, 0.0, request(Kind::Part, 50.0, 150.0 * sign, 2.0))));
    }
    all
}

/// Volume by columns. Each ends where the lowest point, computed with the frames, reaches the table. A column fills
/// the volume (1 + da/dy (z - da)) dz of the part's space, with da/dy by differences.
fn by_columns(machine: &Machine, question: &Request, [low, high]: [[f64; 2]; 2], n: u32) -> f64 {
    let sizes = [0, 1].map(|axis| (high[axis] - low[axis]) / f64::from(n));
    let tool = Clearance {
        least: question.table_clearance.unwrap(),
        tool_length: question.tool_length,
        tool_radius: question.tool_radius,
    };
    let mut sum = 0.0;
    for i in 0..n {
        for j in 0..n {
            let (u, v) = (f64::from(j) * 0.754_877_666_246_692_7, f64::from(i) * 0.618_033_988_749_894_9);
            let x = low[0] + sizes[0] * (f64::from(i) + u.fract());
            let y = low[1] + sizes[1] * (f64::from(j) + v.fract());
            let Some([bottom, top]) = column_lattice::column(machine, x, y) else { continue };
            let pose = |y: f64, z: f64| platform_working(machine, [x, y, z]).map(|posture| posture.pose);
            let Ok(here) = pose(y, bottom) else { continue };
            let theta1 = table_angles(machine, here.alpha, question.phi1, 0.0).theta1;
            let tilt = machine.data().limits.tilt;
            if !(tilt[0]..=tilt[1]).contains(&theta1) {
                continue;
            }
            let over = |z: f64| {
                let (s, _) = question.phi1.sin_cos();
                let joint = machine.data().geometry.R1.max(machine.data().geometry.R2) * s.abs();
                let p = height(machine, [x, y, z], theta1);
                let tip = p - tool.tool_length * question.phi1.cos() - tool.tool_radius * s.abs();
                tip.min(p - joint) - tool.least
            };
            let (mut from, mut to) = (bottom, top);
            let (first, last) = (over(bottom), over(top));
            let zero = bottom + (top - bottom) * first / (first - last);
            match (first >= 0.0, last >= 0.0) {
                (true, true) => {}
                (true, false) => to = zero,
                (false, true) => from = zero,
                (false, false) => continue,
            }
            let (Ok(before), Ok(after)) = (pose(y - 1e-3, bottom), pose(y + 1e-3, bottom)) else { continue };
            let rate = (after.alpha - before.alpha) / 2e-3;
            let da = machine.data().table.da;
            sum += (to - from) * (1.0 + rate * (0.5 * (from + to) - da));
        }
    }
    (sum * sizes[0] * sizes[1]).abs()
}

#[test]
fn volumes_are_those_of_columns_that_end_at_the_table() {
    let (mut cut, mut beyond) = (0, 0);
    for (machine, question) in cut_ones() {
        let free = Request { table_clearance: None, ..question };
        let whole = measure(&machine, &free, &Unobserved).unwrap();
        let Volume::Value { value: uncut, .. } = whole.volume else { continue };
        let [value, error] = volume(&machine, &question);
        let platform =
            surface(&machine, &request(Kind::Platform, 0.0, 0.0, 2.0), &Unobserved).unwrap().bounds();
        let [low, high] = platform.unwrap();
        let box_ = [[low[0] - 3.0, low[1] - 3.0], [high[0] + 3.0, high[1] + 3.0]];
        let brute = by_columns(&machine, &question, box_, 400);
        assert!(
            (value - brute).abs() <= error + 1e-3 * uncut,
            "{value} ± {error}, columns {brute}, uncut {uncut}: {question:?} {:?}",
            machine.data()
        );
        let bites = value > 0.01 * uncut && value < 0.99 * uncut;
        cut += usize::from(bites);
        beyond += usize::from(bites && question.phi1.abs() > FRAC_PI_2);
    }
    assert!(cut > 10 && beyond > 3, "{beyond} of {cut}");
}

/// The volumes for two clearances differ by the sum of the slices between them.
#[test]
fn volumes_for_two_clearances_differ_by_the_slices_between_them() {
    let machine = Machine::verne();
    for (length, phi1) in [(400.0, 0.0), (250.0, 30.0)] {
        let question = |least| above(least, 20.0, request(Kind::Part, length, phi1, 0.1));
        let [[low, _], [high, _]] = [20.0, 140.0].map(|least| volume(&machine, &question(least)));
        // The tool is lowest in both: the floor of its centre is so far above the clearance.
        let up = 20.0 * phi1.to_radians().sin().abs();
        let area = |z: f64| {
            slice(&machine, &Request { table_clearance: None, ..question(0.0) }, z + up, &[], &Unobserved)
                .unwrap()
                .area()
        };
        let steps = 40;
        let step = 120.0 / f64::from(steps);
        let between: f64 = (0..steps)
            .map(|n| {
                let z = 20.0 + step * f64::from(n);
                step / 6.0 * (area(z) + 4.0 * area(z + 0.5 * step) + area(z + step))
            })
            .sum();
        assert!((low - high - between).abs() < 1e-4 * low, "{low} {high} {between}");
    }
}

/// A slice below the table is empty. One above it is the same as without the table.
#[test]
fn slices_below_the_table_are_empty() {
    let machine = Machine::verne();
    let question = above(40.0, 0.0, request(Kind::Part, 400.0, 0.0, 1.0));
    let area = |question: &Request, z| slice(&machine, question, z, &[0.0], &Unobserved).unwrap();
    let free = Request { table_clearance: None, ..question };
    for z in [-100.0, 0.0, 39.9] {
        assert!(area(&free, z).area() > 1e4);
        let cut = area(&question, z);
        assert!(cut.polygons.is_empty() && cut.contours.is_empty());
    }
    for z in [40.0, 41.0, 200.0] {
        assert_eq!(area(&question, z), area(&free, z));
    }
}

fn made(machine: &Machine, question: &Request) -> Surface {
    surface(machine, question, &Unobserved).unwrap()
}

/// The floor of the tool centre point.
fn floor(machine: &Machine, question: &Request) -> f64 {
    let (g, (s, c)) = (machine.data().geometry, question.phi1.sin_cos());
    let joint = g.R1.max(g.R2) * s.abs() - question.tool_length * c;
    question.table_clearance.unwrap() + (question.tool_radius * s.abs()).max(joint)
}

/// Meshes are closed, enclose the volume and end at the table, and their triangles there name the table.
#[test]
fn surfaces_end_at_the_table_and_name_it() {
    let mut stood = 0;
    for (machine, question) in cut_ones() {
        let mesh = made(&machine, &question);
        let topology = Topology::of(&mesh);
        assert!(topology.is_manifold(), "{topology:?} {question:?} {:?}", machine.data());
        let answer = measure(&machine, &question, &Unobserved).unwrap();
        let Volume::Value { value, error } = answer.volume else { continue };
        let allowed = error + question.tolerance * 4.0 * answer.area;
        assert!(
            (mesh.volume() - value).abs() <= allowed,
            "{} {value} ± {allowed}: {question:?} {:?}",
            mesh.volume(),
            machine.data()
        );
        let floor = floor(&machine, &question);
        let lowest = mesh.positions.iter().map(|position| position[2]).fold(f64::INFINITY, f64::min);
        assert!(lowest >= floor - question.tolerance, "{lowest} {floor} {question:?} {:?}", machine.data());
        for (triangle, binding) in mesh.triangles.iter().zip(&mesh.bindings) {
            if binding.constraint == Constraint::TableClearance {
                stood += 1;
                let flat = triangle
                    .iter()
                    .all(|&corner| (mesh.positions[corner as usize][2] - floor).abs() <= question.tolerance);
                assert!(flat, "{question:?} {:?}", machine.data());
            }
        }
    }
    assert!(stood > 1_000, "{stood}");
}

/// Random machines and requests. The table is vertical somewhere for many of them.
#[test]
fn surfaces_of_random_machines_above_the_table_are_closed() {
    let mut numbers = Random::new(0x5eed_0013);
    let mut made_ones = 0;
    for _ in 0..60 {
        let Some(mut data) = random(&mut numbers).map(|machine| machine.data().clone()) else { continue };
        data.limits.tilt = [-3.1, 3.1];
        data.table.dt = numbers.between(-200.0, 400.0);
        let Ok(machine) = Machine::new(data) else { continue };
        let question = above(
            numbers.between(0.0, 100.0),
            numbers.between(-50.0, 50.0).max(0.0),
            request(Kind::Part, numbers.between(0.0, 400.0), numbers.between(-180.0, 180.0), 8.0),
        );
        let mesh = made(&machine, &question);
        assert!(Topology::of(&mesh).is_manifold(), "{question:?} {:?}", machine.data());
        made_ones += usize::from(!mesh.triangles.is_empty());
    }
    assert!(made_ones > 15, "{made_ones}");
}

/// Membership says inside exactly if the inverse solution keeps every margin, including the table's. A point whose
/// tool or joint is too low is outside. A member of the uncut workspace is a member of the cut one exactly if it is
/// above the floor.
#[test]
fn membership_above_the_table_agrees_with_the_margins() {
    let mut numbers = Random::new(0xfeed_0007);
    let (mut inside, mut by_table) = (0, 0);
    for (machine, question) in cut_ones() {
        let Some([low, high]) = made(&machine, &Request { table_clearance: None, ..question }).bounds()
        else {
            continue;
        };
        let points: Vec<[f64; 3]> =
            (0..3_000).map(|_| [0, 1, 2].map(|axis| numbers.between(low[axis], high[axis]))).collect();
        let members = contains(&machine, &question, &points, &Unobserved).unwrap();
        let free = Request { table_clearance: None, ..question };
        let uncut = contains(&machine, &free, &points, &Unobserved).unwrap();
        let floor = floor(&machine, &question);
        for ((&[x, y, z], member), uncut) in points.iter().zip(members).zip(uncut) {
            assert_eq!(member.inside, uncut.inside && z >= floor, "{z} {floor} {question:?}");
            inside += usize::from(member.inside);
            let pose = PartPose { x, y, z, phi1: question.phi1, phi2: question.phi2 };
            let Ok(posture) = part_working(&machine, &pose, question.tool_length) else { continue };
            let table = table_angles(&machine, posture.pose.alpha, pose.phi1, pose.phi2);
            let tool = Clearance {
                least: question.table_clearance.unwrap(),
                tool_length: question.tool_length,
                tool_radius: question.tool_radius,
            };
            let margins = Margins::above_table(&machine, &posture, Some(table), Some(&tool));
            assert_eq!(member.inside, margins.feasible(), "{pose:?} {margins:?}");
            assert_eq!(member.margin, Some(margins.worst(&machine)));
            by_table += usize::from(uncut.inside && !member.inside);
        }
    }
    assert!(inside > 5_000 && by_table > 5_000, "{inside} {by_table}");
}

/// The machine's own clearance applies if the request gives none.
#[test]
fn the_clearance_of_a_request_overrides_that_of_the_machine() {
    let machine = changed(|data| data.limits.table_clearance = Some(100.0));
    let plain = request(Kind::Part, 400.0, 0.0, 1.0);
    let asked = |least| above(least, 0.0, plain);
    let verne = Machine::verne();
    assert_eq!(volume(&machine, &plain), volume(&verne, &asked(100.0)));
    assert_eq!(volume(&machine, &asked(30.0)), volume(&verne, &asked(30.0)));
    for kind in [Kind::Platform, Kind::Tool] {
        let question = request(kind, 400.0, 0.0, 1.0);
        assert_eq!(volume(&machine, &question), volume(&verne, &question));
    }
    let refused = |least| {
        let mut data = verne.data().clone();
        data.limits.table_clearance = Some(least);
        Machine::new(data).unwrap_err()[0].field == "limits/table_clearance"
    };
    assert!([-1.0, f64::NAN, f64::INFINITY, 2e6].into_iter().all(refused));
}
