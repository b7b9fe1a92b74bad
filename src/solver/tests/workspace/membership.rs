//! Membership against solution and margins.

use verne_solver::workspace::{Kind, Unobserved, contains};
use verne_solver::{Machine, Margins, PartPose, part_working, platform_working, table_angles};

use crate::machines::{Random, request};

#[test]
fn is_solution_and_margins() {
    let machine = Machine::verne();
    let mut random = Random(0x9e37_79b9);
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
    // The share of the box that is inside tells the volume.
    let inside = answers.iter().filter(|answer| answer.inside).count() as f64 / 1e5;
    assert!((inside * 900.0 * 1_200.0 * 900.0 - 2.337e8).abs() < 3e6);
}

#[test]
fn of_parts_uses_the_table() {
    let machine = Machine::verne();
    let question = request(Kind::Part, 50.0, 60.0, 1.0);
    let mut random = Random(0x1234_5678);
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
