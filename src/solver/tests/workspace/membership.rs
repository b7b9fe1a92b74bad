//! Membership compared with solution and margins.

use verne_solver::workspace::{Kind, Request, Unobserved, contains};
use verne_solver::{
    Clearance, Constraint, Machine, Margin, Margins, PartPose, Posture, part_every_working, part_working,
    platform_working, table_angles, tool_every_working,
};

use crate::machines::{changed, others, random};
use crate::random::Random;
use crate::requests::{above, request};

#[test]
fn a_point_is_a_member_if_its_solution_keeps_all_margins() {
    let machine = Machine::verne();
    let mut random = Random::new(0x9e37_79b9);
    let points: Vec<[f64; 3]> = (0..100_000)
        .map(|_| {
            [random.between(-450.0, 450.0), random.between(-600.0, 600.0), random.between(800.0, 1_700.0)]
        })
        .collect();
    let answers = contains(&machine, &request(Kind::Platform, 0.0, 0.0, 1.0), &points, &Unobserved).unwrap();
    assert_eq!(answers.len(), points.len());
    for (point, answer) in points.iter().zip(&answers) {
        let posture = platform_working(&machine, *point);
        let inside = posture.is_ok_and(|posture| Margins::of(&machine, &posture, None).feasible());
        assert_eq!(inside, answer.inside, "{point:?}");
        assert_eq!(inside, answer.margin.unwrap().value >= 0.0, "{point:?}");
    }
    // The fraction of the box that is inside gives the volume.
    let inside = answers.iter().filter(|answer| answer.inside).count() as f64 / 1e5;
    assert!((inside * 900.0 * 1_200.0 * 900.0 - 2.337e8).abs() < 3e6);
}

#[test]
fn membership_of_a_part_workspace_depends_on_the_table() {
    let machine = Machine::verne();
    let question = request(Kind::Part, 50.0, 60.0, 1.0);
    let mut random = Random::new(0x1234_5678);
    let points: Vec<[f64; 3]> = (0..5_000)
        .map(|_| {
            [random.between(-450.0, 450.0), random.between(-700.0, 400.0), random.between(-400.0, 950.0)]
        })
        .collect();
    let answers = contains(&machine, &question, &points, &Unobserved).unwrap();
    for (&[x, y, z], answer) in points.iter().zip(&answers) {
        let pose = PartPose { x, y, z, phi1: question.phi1, phi2: 0.0 };
        let inside = part_working(&machine, &pose, 50.0).is_ok_and(|posture| {
            let table = table_angles(&machine, posture.pose.alpha, question.phi1, 0.0);
            Margins::of(&machine, &posture, Some(table)).feasible()
        });
        assert_eq!(inside, answer.inside);
    }
    assert!(answers.iter().any(|answer| answer.inside));
}

/// The worst margin of each working solution, computed in full.
fn worst_of_all(machine: &Machine, request: &Request, [x, y, z]: [f64; 3]) -> Vec<Margin> {
    let Request { tool_length, phi1, phi2, .. } = *request;
    let found = match request.kind {
        Kind::Platform => platform_working(machine, [x, y, z]).map(|posture| [posture].into_iter().collect()),
        Kind::Tool => tool_every_working(machine, [x, y, z], tool_length),
        Kind::Part => part_every_working(machine, &PartPose { x, y, z, phi1, phi2 }, tool_length),
    };
    let worst = |posture: &Posture| {
        let table = (request.kind == Kind::Part)
            .then(|| table_angles(machine, posture.pose.alpha, phi1, request.phi2));
        let clearance = Clearance::of(machine, request.table_clearance, tool_length, request.tool_radius);
        Margins::above_table(machine, posture, table, clearance.as_ref()).worst(machine)
    };
    found.iter().flatten().map(worst).collect()
}

/// A member's margin is computed without most constraints. It is the worst margin of one working solution, to the
/// last bit, whichever constraint that is. Of several solutions it is that of a feasible one.
#[test]
fn the_reported_margin_is_the_worst_of_one_solution() {
    let mut numbers = Random::new(0x5851_f42d);
    let mut machines: Vec<Machine> = others().into_iter().map(|(_, machine)| machine).collect();
    machines.push(Machine::verne());
    machines.push(changed(|data| data.limits.parallel_margin = 0.9));
    machines.extend(std::iter::repeat_with(|| random(&mut numbers)).take(60).flatten());
    let (mut solved, mut inside) = (0, 0);
    let mut named = std::collections::HashSet::new();
    for machine in machines {
        for question in [
            request(Kind::Platform, 0.0, 0.0, 1.0),
            request(Kind::Tool, 150.0, 0.0, 1.0),
            Request { phi2: 0.4, ..request(Kind::Part, 50.0, 35.0, 1.0) },
            above(60.0, 30.0, Request { phi2: 0.4, ..request(Kind::Part, 50.0, 35.0, 1.0) }),
        ] {
            let [low, high] = if question.kind == Kind::Part { [-400.0, 1_000.0] } else { [700.0, 1_800.0] };
            let points: Vec<[f64; 3]> = (0..1_200)
                .map(|_| {
                    let across = [numbers.between(-450.0, 450.0), numbers.between(-650.0, 650.0)];
                    [across[0], across[1], numbers.between(low, high)]
                })
                .collect();
            let answers = contains(&machine, &question, &points, &Unobserved).unwrap();
            for (point, answer) in points.iter().zip(answers) {
                let worst = worst_of_all(&machine, &question, *point);
                if worst.is_empty() {
                    continue;
                }
                let named_worst = answer.margin.filter(|margin| worst.contains(margin));
                let named_worst =
                    named_worst.unwrap_or_else(|| panic!("{point:?} {question:?} {answer:?} {worst:?}"));
                assert_eq!(answer.inside, worst.iter().any(|margin| margin.value >= 0.0));
                assert_eq!(answer.inside, named_worst.value >= 0.0);
                (solved, inside) = (solved + 1, inside + usize::from(answer.inside));
                named.insert(named_worst.constraint);
            }
        }
    }
    assert!(solved > 100_000 && inside > 10_000, "{inside} of {solved}");
    let all = [
        Constraint::Stroke,
        Constraint::SerialSingularity,
        Constraint::ParallelSingularity,
        Constraint::SliderJoint,
        Constraint::PlatformJoint,
        Constraint::RodInterference,
        Constraint::Tilt,
        Constraint::TableClearance,
    ];
    assert!(all.iter().all(|constraint| named.contains(constraint)), "{named:?}");
}
