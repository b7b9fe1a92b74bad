//! Arbitrary numbers: no panic, no NaN, and only postures that satisfy the equations.

use nalgebra::Vector4;
use verne_solver::{
    KinematicsError, MAX_INPUT, Machine, PartPose, Posture, forward, forward_working, part, part_working,
    platform, platform_working, tool, tool_working,
};

use crate::lengths::scale;
use crate::oracle::Legs;
use crate::random::Random;

/// Any double: a random bit pattern, a special value, or a number of the machine's own size.
fn number(draw: &mut Random, unit: f64) -> f64 {
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
        MAX_INPUT,
        -MAX_INPUT,
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

/// The violations in the answers, and the number of postures.
#[derive(Default)]
struct Findings {
    unsound: Vec<String>,
    postures: usize,
}

impl Findings {
    fn check(
        &mut self,
        what: &str,
        machine: &Machine,
        numbers: &[f64],
        answer: &Result<Vec<Posture>, KinematicsError>,
    ) {
        let outside = numbers.iter().any(|n| n.is_nan() || n.abs() > MAX_INPUT);
        let sound = match answer {
            Ok(postures) => !outside && !postures.is_empty(),
            Err(KinematicsError::OutOfDomain) => outside,
            Err(KinematicsError::OutOfProportion) => !outside,
            Err(KinematicsError::Unreachable(margin)) => {
                !outside && margin.value < 0.0 && margin.value.is_finite()
            }
            Err(KinematicsError::SelfMotion) => false,
        };
        let postures = answer.as_deref().unwrap_or_default();
        self.postures += postures.len();
        if !sound || !postures.iter().all(|posture| solves(machine, posture, numbers)) {
            self.unsound.push(format!("{what} {numbers:?} {:?}: {answer:?}", machine.data().geometry));
        }
    }

    fn conclude(&self, postures: usize) {
        let first = self.unsound.iter().take(5).cloned().collect::<Vec<_>>().join("\n");
        assert!(self.unsound.is_empty(), "{} unsound; the first:\n{first}", self.unsound.len());
        assert!(self.postures > postures, "{}", self.postures);
    }
}

/// The posture is made of finite numbers that satisfy the equations, and its residual is true.
fn solves(machine: &Machine, posture: &Posture, question: &[f64]) -> bool {
    let p = &posture.pose;
    let all = [p.x, p.y, p.z, p.alpha, posture.rho[0], posture.rho[1], posture.rho[2], posture.residual];
    // Far from the origin, or on a long tool, the numbers themselves have no more digits.
    let largest = all.iter().chain(question).fold(0.0_f64, |most, n| most.max(n.abs()));
    let allowed = 9e-13 * scale(machine) + 4.0 * f64::EPSILON * largest;
    let truly = Legs::of(machine).residual(&Vector4::new(p.x, p.y, p.z, p.alpha), &posture.rho);
    all.iter().all(|n| n.is_finite())
        && p.alpha > -std::f64::consts::PI
        && p.alpha <= std::f64::consts::PI
        && truly <= allowed
        && posture.residual >= 0.0
        && (posture.residual - truly).abs() <= allowed
}

fn many(answer: Result<verne_solver::Postures, KinematicsError>) -> Result<Vec<Posture>, KinematicsError> {
    answer.map(|postures| postures.into_iter().collect())
}

fn one(answer: Result<Posture, KinematicsError>) -> Result<Vec<Posture>, KinematicsError> {
    answer.map(|posture| vec![posture])
}

#[test]
fn arbitrary_numbers_in_forward_and_platform_give_valid_postures() {
    let (mut draw, mut findings) = (Random::new(151), Findings::default());
    for _ in 0..10_000 {
        let machine = draw.any_machine();
        let n = [0, 1, 2].map(|_| number(&mut draw, scale(&machine)));
        findings.check("forward", &machine, &n, &many(forward(&machine, n)));
        findings.check("forward_working", &machine, &n, &one(forward_working(&machine, n)));
        findings.check("platform", &machine, &n, &many(platform(&machine, n)));
        findings.check("platform_working", &machine, &n, &one(platform_working(&machine, n)));
    }
    findings.conclude(2000);
}

#[test]
fn arbitrary_numbers_in_tool_and_part_give_valid_postures() {
    let (mut draw, mut findings) = (Random::new(152), Findings::default());
    for _ in 0..10_000 {
        let machine = draw.any_machine();
        let n = [0; 4].map(|_| number(&mut draw, scale(&machine)));
        let (u, length) = ([n[0], n[1], n[2]], n[3]);
        findings.check("tool", &machine, &n, &many(tool(&machine, u, length)));
        findings.check("tool_working", &machine, &n, &one(tool_working(&machine, u, length)));
        let phi = [0; 2].map(|_| number(&mut draw, 3.0));
        let n = [n[0], n[1], n[2], n[3], phi[0], phi[1]];
        let target = PartPose { x: n[0], y: n[1], z: n[2], phi1: n[4], phi2: n[5] };
        findings.check("part", &machine, &n, &many(part(&machine, &target, length)));
        findings.check("part_working", &machine, &n, &one(part_working(&machine, &target, length)));
    }
    findings.conclude(1000);
}
