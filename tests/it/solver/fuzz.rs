//! Numbers of every kind: no panic, no NaN, and only postures that satisfy the equations.

use nalgebra::Vector4;
use verne_solver::{
    DOMAIN, Machine, PartPose, Posture, Refusal, forward, forward_working, part, part_working, platform,
    platform_working, tool, tool_working,
};

use crate::machines::{Draw, scale};
use crate::oracle::Legs;

/// Any double: a random bit pattern, a special value, or a number of the machine's own size.
fn number(draw: &mut Draw, unit: f64) -> f64 {
    const SPECIAL: [f64; 16] = [
        0.0,
        -0.0,
        1.0,
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::MAX,
        f64::MIN_POSITIVE,
        5e-324,
        1e300,
        -1e300,
        DOMAIN,
        -DOMAIN,
        1e-9,
        1e6,
        f64::EPSILON,
    ];
    match draw.pick(&[0, 1, 2, 2, 2, 3, 4]) {
        0 => f64::from_bits(draw.bits()),
        1 => draw.pick(&SPECIAL),
        2 => unit * draw.between(-1.5, 1.5),
        3 => unit * draw.pick(&[0.0, 0.0, 0.25, 0.5, 1.0, -0.5]),
        _ => draw.magnitude(1e-15, 1e7) * draw.pick(&[1.0, -1.0]),
    }
}

/// The answer to a question with the numbers given is sound.
fn check(what: &str, machine: &Machine, numbers: &[f64], answer: Result<Vec<Posture>, Refusal>) -> usize {
    let outside = numbers.iter().any(|n| n.is_nan() || n.abs() > DOMAIN);
    let question = format!("{what} {numbers:?}");
    match answer {
        Ok(postures) => {
            assert!(!outside && !postures.is_empty(), "{question}: {postures:?}");
            postures.iter().for_each(|posture| check_posture(&question, machine, posture));
            postures.len()
        }
        Err(Refusal::OutOfDomain) => {
            assert!(outside, "{question}: out of domain");
            0
        }
        Err(Refusal::Blocked(margin)) => {
            assert!(!outside && margin.value < 0.0 && margin.value.is_finite(), "{question}: {margin:?}");
            0
        }
        Err(Refusal::SelfMotion) => panic!("{question}: self-motion"),
    }
}

fn check_posture(question: &str, machine: &Machine, posture: &Posture) {
    let p = &posture.pose;
    let all = [p.x, p.y, p.z, p.alpha, posture.rho[0], posture.rho[1], posture.rho[2], posture.residual];
    assert!(all.iter().all(|n| n.is_finite()), "{question}: {posture:?}");
    assert!(p.alpha > -std::f64::consts::PI && p.alpha <= std::f64::consts::PI, "{question}: {posture:?}");
    // Far from the origin, z and rho themselves have no more digits.
    let largest = all[..7].iter().fold(0.0_f64, |most, n| most.max(n.abs()));
    let allowed = 9e-13 * scale(machine) + 4.0 * f64::EPSILON * largest;
    let legs = Legs::of(machine);
    let truly = legs.residual(&Vector4::new(p.x, p.y, p.z, p.alpha), &posture.rho);
    assert!(posture.residual <= allowed && truly <= allowed, "{question}: {truly:e} {posture:?}");
    assert!(
        posture.residual >= 0.0 && (posture.residual - truly).abs() < allowed,
        "{question}: {truly:e} {posture:?}"
    );
}

fn many(answer: Result<verne_solver::Postures, Refusal>) -> Result<Vec<Posture>, Refusal> {
    answer.map(|postures| postures.into_iter().collect())
}

fn one(answer: Result<Posture, Refusal>) -> Result<Vec<Posture>, Refusal> {
    answer.map(|posture| vec![posture])
}

#[test]
fn forward_and_platform() {
    let (mut draw, mut solved) = (Draw::seeded(151), 0);
    for _ in 0..10_000 {
        let machine = draw.any_machine();
        let n = [0, 1, 2].map(|_| number(&mut draw, scale(&machine)));
        solved += check("forward", &machine, &n, many(forward(&machine, n)));
        solved += check("forward_working", &machine, &n, one(forward_working(&machine, n)));
        solved += check("platform", &machine, &n, many(platform(&machine, n)));
        solved += check("platform_working", &machine, &n, one(platform_working(&machine, n)));
    }
    assert!(solved > 2000, "{solved}");
}

#[test]
fn tool_and_part() {
    let (mut draw, mut solved) = (Draw::seeded(152), 0);
    for _ in 0..10_000 {
        let machine = draw.any_machine();
        let n = [0; 4].map(|_| number(&mut draw, scale(&machine)));
        let (u, length) = ([n[0], n[1], n[2]], n[3]);
        solved += check("tool", &machine, &n, many(tool(&machine, u, length)));
        solved += check("tool_working", &machine, &n, one(tool_working(&machine, u, length)));
        let phi = [0; 2].map(|_| number(&mut draw, 3.0));
        let n = [n[0], n[1], n[2], n[3], phi[0], phi[1]];
        let target = PartPose { x: n[0], y: n[1], z: n[2], phi1: n[4], phi2: n[5] };
        solved += check("part", &machine, &n, many(part(&machine, &target, length)));
        solved += check("part_working", &machine, &n, one(part_working(&machine, &target, length)));
    }
    assert!(solved > 1000, "{solved}");
}
