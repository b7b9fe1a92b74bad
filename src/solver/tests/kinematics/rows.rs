//! The functions of many rows answer as those of one row do, to the last bit, with every kind of registers.

use std::f64::consts::{FRAC_PI_2, PI};

use verne_solver::{
    Clearance, KinematicsError, Machine, Margins, PartPose, Point, Posture, PostureColumns, Registers,
    TableAngles, forward_working, forward_working_rows, margin_rows, part_working, part_working_rows,
    platform_working, platform_working_rows, table_angles, tool_working, tool_working_rows,
    worst_margin_rows,
};

use crate::random::Random;

const REGISTERS: [Registers; 3] = [Registers::Widest, Registers::Avx2, Registers::Baseline];
const CLEARANCE: Clearance = Clearance { least: 2.0, tool_length: 120.0, tool_radius: 5.0 };
/// More rows than two blocks have.
const MOST_ROWS: usize = 70;

type Answer = Result<Posture, KinematicsError>;

/// Every bit of an answer: `Debug` writes the shortest digits that identify a number, and the sign of a zero.
fn bits<T: std::fmt::Debug>(answer: &T) -> String {
    format!("{answer:?}")
}

/// Compares the answers of a function of many rows with those of one row.
fn compare<T: std::fmt::Debug, A: std::fmt::Debug>(
    machine: &Machine,
    rows: &[T],
    one: impl Fn(&T) -> A,
    many: impl Fn(Registers, &mut dyn FnMut(usize, A)),
) {
    for registers in REGISTERS {
        let mut answers = Vec::new();
        many(registers, &mut |i, answer| {
            assert_eq!(i, answers.len(), "the order of the rows");
            answers.push(bits(&answer));
        });
        assert_eq!(answers.len(), rows.len());
        for (row, answer) in rows.iter().zip(answers) {
            assert_eq!(answer, bits(&one(row)), "{registers:?}, {row:?}, {:?}", machine.data());
        }
    }
}

fn compare_parts(machine: &Machine, rows: &[PartPose], length: f64) {
    compare(
        machine,
        rows,
        |row| part_working(machine, row, length),
        |registers, found| part_working_rows(machine, rows, length, registers, found),
    );
}

fn compare_points(machine: &Machine, rows: &[Point], length: f64) {
    compare(
        machine,
        rows,
        |&row| tool_working(machine, row, length),
        |registers, found| tool_working_rows(machine, rows, length, registers, found),
    );
    compare(
        machine,
        rows,
        |&row| platform_working(machine, row),
        |registers, found| platform_working_rows(machine, rows, registers, found),
    );
}

fn compare_sliders(machine: &Machine, rows: &[[f64; 3]]) {
    compare(
        machine,
        rows,
        |&row| forward_working(machine, row),
        |registers, found| forward_working_rows(machine, rows, registers, found),
    );
}

fn compare_margins(machine: &Machine, rows: &[(Posture, Option<TableAngles>)]) {
    let mut columns = PostureColumns::new();
    for (posture, table) in rows {
        columns.push(posture, *table);
    }
    for clearance in [None, Some(&CLEARANCE)] {
        let margins = |posture: &Posture, table: Option<TableAngles>| {
            Margins::above_table(machine, posture, table, clearance)
        };
        compare(
            machine,
            rows,
            |(posture, table)| margins(posture, *table),
            |registers, found| {
                margin_rows(machine, &columns, clearance, registers, |first, block| {
                    (0..block.len()).for_each(|i| found(first + i, block.row(i)));
                });
            },
        );
        compare(
            machine,
            rows,
            |(posture, table)| {
                let margins = margins(posture, *table);
                (margins.worst(machine), margins.feasible())
            },
            |registers, found| {
                worst_margin_rows(machine, &columns, clearance, registers, |i, worst, feasible| {
                    found(i, (worst, feasible));
                });
            },
        );
    }
}

/// A length: of the machine's order, zero, on one of its own, or far outside.
fn length(random: &mut Random, machine: &Machine) -> f64 {
    let (g, longest) = (machine.data().geometry, machine.longest());
    match random.pick(&[0, 0, 0, 0, 0, 0, 1, 2, 3, 4]) {
        0 => longest * random.between(-1.5, 1.5),
        1 => 0.0,
        2 => random.pick(&[g.L1, -g.L2, g.r4, g.d1 - g.D1, g.d2 - g.D2, g.d1 - g.D1 + g.L1]),
        3 => longest * random.between(-2e4, 2e4),
        _ => random.pick(&[1e7, -2e7, f64::MAX, f64::MIN_POSITIVE, -0.0]),
    }
}

/// An angle of some turns, a multiple of a quarter turn, or a large one.
fn angle(random: &mut Random) -> f64 {
    match random.pick(&[0, 0, 0, 0, 1, 2]) {
        0 => random.between(-4.0, 4.0),
        1 => FRAC_PI_2 * random.pick(&[-4.0, -2.0, -1.0, 0.0, 1.0, 2.0]),
        _ => random.pick(&[9.9e4, 1e5, -1e6, 1e7, 1e8, 1e-300]),
    }
}

fn part_pose(random: &mut Random, machine: &Machine) -> PartPose {
    let [x, y, z] = [0; 3].map(|_| length(random, machine));
    // The pole phi1 = 0 among them.
    let phi1 = if random.one_in(6) { 0.0 } else { angle(random) };
    PartPose { x, y, z, phi1, phi2: angle(random) }
}

fn tool_length(random: &mut Random, machine: &Machine) -> f64 {
    if random.one_in(4) { length(random, machine) } else { machine.longest() * random.between(0.0, 0.5) }
}

#[test]
fn any_rows_of_any_machine_have_the_answers_of_single_rows() {
    let mut random = Random::new(0x0005_EED5);
    for _ in 0..120 {
        let machine = random.any_machine();
        let count = 1 + (random.bits() % 96) as usize;
        let length_of_tool = tool_length(&mut random, &machine);
        let parts: Vec<_> = (0..count).map(|_| part_pose(&mut random, &machine)).collect();
        compare_parts(&machine, &parts, length_of_tool);
        let points: Vec<Point> = (0..count).map(|_| [0; 3].map(|_| length(&mut random, &machine))).collect();
        compare_points(&machine, &points, length_of_tool);
        compare_sliders(&machine, &points);
    }
}

/// Postures of a machine near its workspace, and on its symmetry plane.
fn postures(random: &mut Random, machine: &Machine, count: usize) -> Vec<Posture> {
    let longest = machine.longest();
    let mut point = || {
        let y = if random.one_in(5) { 0.0 } else { 0.3 * longest * random.between(-1.0, 1.0) };
        [0.3 * longest * random.between(-1.0, 1.0), y, longest * random.between(0.5, 1.5)]
    };
    (0..20 * count).filter_map(|_| platform_working(machine, point()).ok()).take(count).collect()
}

#[test]
fn the_rows_of_reachable_postures_have_the_answers_of_single_rows() {
    let mut random = Random::new(0x0005_EED6);
    for _ in 0..60 {
        let machine = random.any_machine();
        let all = postures(&mut random, &machine, 96);
        compare_sliders(&machine, &all.iter().map(|posture| posture.rho).collect::<Vec<_>>());
        let tables: Vec<_> = all
            .iter()
            .map(|posture| {
                let table = table_angles(&machine, posture.pose.alpha, random.between(-1.0, 1.0), 0.5);
                (*posture, (!random.one_in(3)).then_some(table))
            })
            .collect();
        compare_margins(&machine, &tables);
        let length = tool_length(&mut random, &machine);
        let parts: Vec<_> = tables
            .iter()
            .filter_map(|(posture, table)| {
                Some(verne_solver::part_pose(&machine, &posture.pose, (*table)?, length))
            })
            .collect();
        compare_parts(&machine, &parts, length);
        let tools: Vec<_> =
            all.iter().map(|posture| verne_solver::tool_point(&posture.pose, length)).collect();
        compare_points(&machine, &tools, length);
    }
}

#[test]
fn margins_of_any_posture_are_those_of_a_single_row() {
    let mut random = Random::new(0x0005_EED7);
    for _ in 0..40 {
        let machine = random.any_machine();
        let Some(first) = postures(&mut random, &machine, 1).pop() else { continue };
        let rows: Vec<_> = (0..50)
            .map(|_| {
                let mut posture = first;
                let spread = machine.longest() * random.pick(&[1e-9, 1e-3, 1.0]);
                posture.pose.x += spread * random.between(-1.0, 1.0);
                posture.pose.y += spread * random.between(-1.0, 1.0);
                posture.pose.z += spread * random.between(-1.0, 1.0);
                posture.pose.alpha += random.pick(&[0.0, 0.1, 3.0, 2e5]) * random.between(-1.0, 1.0);
                posture.rho = posture.rho.map(|rho| rho + spread * random.between(-1.0, 1.0));
                (posture, None)
            })
            .collect();
        compare_margins(&machine, &rows);
    }
}

#[test]
fn rows_of_an_unlimited_rotary_table_have_no_margin_of_its_range() {
    let mut data = Machine::verne().data().clone();
    data.limits.rotary = None;
    let machine = Machine::new(data).unwrap();
    let table = Some(TableAngles { theta1: 0.1, theta2: 40.0 });
    let rows: Vec<_> =
        postures(&mut Random::new(0x0005_EED9), &machine, 40).into_iter().map(|row| (row, table)).collect();
    compare_margins(&machine, &rows);
    let mut columns = PostureColumns::new();
    for (posture, table) in &rows {
        columns.push(posture, *table);
    }
    margin_rows(&machine, &columns, None, Registers::Widest, |_, block| {
        assert!(block.row(0).tilt.is_some() && block.row(0).rotary.is_none());
    });
}

#[test]
fn every_number_of_rows_is_answered() {
    let mut random = Random::new(0x0005_EED8);
    let machine = Machine::verne();
    let all = postures(&mut random, &machine, MOST_ROWS);
    let tables: Vec<_> = all.iter().map(|posture| (*posture, None)).collect();
    let rho: Vec<_> = all.iter().map(|posture| posture.rho).collect();
    let points: Vec<_> = all.iter().map(|posture| verne_solver::tool_point(&posture.pose, 100.0)).collect();
    let parts: Vec<_> =
        points.iter().map(|&[x, y, z]| PartPose { x, y, z: 1700.0 - z, phi1: 0.2, phi2: PI }).collect();
    for count in 0..=MOST_ROWS {
        compare_parts(&machine, &parts[..count], 100.0);
        compare_points(&machine, &points[..count], 100.0);
        compare_sliders(&machine, &rho[..count]);
        compare_margins(&machine, &tables[..count]);
    }
}

#[test]
fn rows_without_a_solution_are_refused_in_their_place() {
    let machine = Machine::verne();
    let far = [0.0, 0.0, 1e7 + 1.0];
    let rows = [[0.0, 0.0, 1200.0], far, [5e3, 0.0, 1200.0], [0.0, 0.0, 1200.0]];
    let mut answers: Vec<Answer> = Vec::new();
    platform_working_rows(&machine, &rows, Registers::Widest, |_, answer| answers.push(answer));
    assert!(answers[0].is_ok() && answers[0] == answers[3]);
    assert_eq!(answers[1], Err(KinematicsError::OutOfDomain));
    assert!(matches!(answers[2], Err(KinematicsError::Unreachable(_))));
}
