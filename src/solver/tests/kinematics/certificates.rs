//! Proofs of solutions: every box has one true solution, completeness is claimed only where it holds, and a solution that
//! is left out is noticed.

use verne_solver::certificate::{
    Certification, EnclosedOrientation, Incomplete, PostureBox, Scope, Unproved, certify_forward,
    certify_part, certify_platform,
};
use verne_solver::{KinematicsError, Machine, PartPose, Posture, forward, part, platform};

use crate::family_edge_sets;
use crate::lengths::scale;
use crate::oracle::{Found, Path, forward as forward_by_force, inverse as inverse_by_force, wrapped};
use crate::proportional_machine;
use crate::questions::Question;
use crate::random::Random;
use crate::reference_cases;

/// x, y, z, alpha, rho1, rho2, rho3.
type Coordinates = [f64; 7];

fn bounds(of: &PostureBox) -> [[f64; 2]; 7] {
    [of.x, of.y, of.z, of.alpha, of.rho[0], of.rho[1], of.rho[2]]
}

/// Whether coordinates are in a box, but for their own error.
fn is_inside(of: &PostureBox, mut at: Coordinates, error: impl Fn(f64) -> f64) -> bool {
    let middle = f64::midpoint(of.alpha[0], of.alpha[1]);
    at[3] = middle + wrapped(at[3] - middle);
    bounds(of).iter().zip(at).all(|([low, high], number)| {
        let error = error(number);
        low - error <= number && number <= high + error
    })
}

/// Two units in the last place of decimals that were read.
fn of_decimals(number: f64) -> f64 {
    2.0 * (number.abs().next_up() - number.abs())
}

fn coordinates(posture: &Posture) -> Coordinates {
    let (p, [a, b, c]) = (&posture.pose, posture.rho);
    [p.x, p.y, p.z, p.alpha, a, b, c]
}

fn of_found(found: &Found) -> Coordinates {
    let (q, [a, b, c]) = (&found.q, found.rho);
    [q[0], q[1], q[2], q[3], a, b, c]
}

fn boxes(proof: &Certification) -> Vec<PostureBox> {
    proof.boxes.iter().filter_map(|found| found.as_ref().ok().copied()).collect()
}

/// Everything is proved, and the boxes are those of the truth.
fn assert_proves(tag: &str, proof: &Certification, truth: &[Coordinates]) {
    assert_eq!(proof.complete, Ok(()), "{tag}: {proof:?}");
    let boxes = boxes(proof);
    assert_eq!((boxes.len(), proof.boxes.len()), (truth.len(), truth.len()), "{tag}");
    for at in truth {
        let hits = boxes.iter().filter(|found| is_inside(found, *at, of_decimals)).count();
        assert_eq!(hits, 1, "{tag}: {at:?} in {boxes:#?}");
    }
}

/// The postures of an answer; none if the request is unreachable.
fn postures(question: &Question, machine: &Machine, scope: Scope) -> Option<Vec<Posture>> {
    match question.answer(machine, scope) {
        Ok(found) => Some(found.to_vec()),
        Err(KinematicsError::Unreachable(_)) => Some(Vec::new()),
        Err(_) => None,
    }
}

fn of_reference(solutions: &[reference_cases::Solution], scope: Scope) -> Vec<Coordinates> {
    let wanted = solutions.iter().filter(|solution| scope == Scope::All || solution.working);
    wanted
        .map(|s| {
            let ([x, y, z], [a, b, c]) = (s.platform, s.rho);
            [x, y, z, s.alpha, a, b, c]
        })
        .collect()
}

#[test]
fn forward_boxes_are_those_of_the_reference() {
    for case in reference_cases::forward() {
        for scope in [Scope::All, Scope::Working] {
            let found = postures(&Question::Forward(case.rho), &case.machine, scope).unwrap();
            let proof = certify_forward(&case.machine, case.rho, &found, scope);
            assert_proves(&case.tag, &proof, &of_reference(&case.solutions, scope));
        }
    }
}

#[test]
fn inverse_boxes_are_those_of_the_reference() {
    for case in reference_cases::inverse() {
        for scope in [Scope::All, Scope::Working] {
            let proof = match (case.pose[..].try_into(), case.tool_length) {
                (Ok(p), None) => {
                    let found = postures(&Question::Platform(p), &case.machine, scope).unwrap();
                    certify_platform(&case.machine, p, &found, scope)
                }
                (_, length) => {
                    let [x, y, z, phi1, phi2] = case.pose[..].try_into().unwrap();
                    let length = length.unwrap();
                    let target = PartPose { x, y, z, phi1, phi2 };
                    let found = postures(&Question::Part(target, length), &case.machine, scope).unwrap();
                    // The set's angles are degrees: no double is the same in radians.
                    let around = |angle: f64| [angle - of_decimals(angle), angle + of_decimals(angle)];
                    let orientation = EnclosedOrientation::within(around(phi1), around(phi2)).unwrap();
                    certify_part(&case.machine, [x, y, z], &orientation, length, &found, scope)
                }
            };
            assert_proves(&case.tag, &proof, &of_reference(&case.solutions, scope));
        }
    }
}

#[test]
fn boxes_near_the_familys_edge_are_those_of_the_reference() {
    for family_edge_sets::Case { tag, machine, rho, solutions } in family_edge_sets::cases() {
        for scope in [Scope::All, Scope::Working] {
            let found = postures(&Question::Forward(rho), &machine, scope).unwrap();
            let wanted = solutions.iter().filter(|(_, working)| scope == Scope::All || *working);
            let truth: Vec<Coordinates> =
                wanted.map(|([x, y, z, alpha], _)| [*x, *y, *z, *alpha, rho[0], rho[1], rho[2]]).collect();
            assert_proves(&tag, &certify_forward(&machine, rho, &found, scope), &truth);
        }
    }
}

fn by_force(question: &Question, machine: &Machine) -> crate::oracle::Answer {
    match *question {
        Question::Forward(rho) => forward_by_force(machine, rho),
        Question::Platform(p) => inverse_by_force(machine, &Path::platform(p)),
        Question::Tool(u, length) => inverse_by_force(machine, &Path::tool(u, length)),
        Question::Part(target, length) => inverse_by_force(machine, &Path::part(machine, &target, length)),
    }
}

#[test]
fn complete_boxes_hold_all_solutions_found_by_force() {
    let mut draw = Random::new(2101);
    let (mut compared, mut solutions) = (0, 0);
    for _ in 0..700 {
        // The search by force needs unlike offsets and R1 > r1.
        let machine = draw.any_machine();
        let question = draw.question(&machine);
        let Some(found) = postures(&question, &machine, Scope::All) else { continue };
        let proof = question.certify(&machine, &found, Scope::All);
        let truth = by_force(&question, &machine);
        if proof.complete.is_err() || truth.continuum || truth.found.iter().any(Found::weak) {
            continue;
        }
        let boxes = boxes(&proof);
        let unit = scale(&machine);
        for solution in &truth.found {
            let error = |_: f64| 1e-12 * unit * solution.amplification.max(1e3);
            let hits = boxes.iter().filter(|found| is_inside(found, of_found(solution), error)).count();
            assert_eq!(hits, 1, "{solution:?} in {boxes:#?} of {question:?} to {machine:?}");
        }
        assert!(boxes.len() == truth.found.len() || !truth.touches.is_empty(), "{question:?} to {machine:?}");
        compared += 1;
        solutions += boxes.len();
    }
    assert!(compared > 600 && solutions > 3_000, "{compared} {solutions}");
}

#[test]
fn a_solution_that_is_left_out_is_noticed() {
    let mut draw = Random::new(2102);
    let mut noticed = 0;
    for _ in 0..2_000 {
        let machine = draw.machine_of_any_kind();
        let question = draw.question(&machine);
        for scope in [Scope::All, Scope::Working] {
            let Some(found) = postures(&question, &machine, scope) else { continue };
            if found.is_empty() || question.certify(&machine, &found, scope).complete.is_err() {
                continue;
            }
            let mut others = found.clone();
            let place = usize::try_from(draw.bits() % found.len() as u64).unwrap();
            let missing = others.remove(place);
            let proof = question.certify(&machine, &others, scope);
            assert!(proof.complete.is_err(), "{missing:?} of {question:?} to {machine:?}");
            noticed += 1;
        }
    }
    assert!(noticed > 2_000, "{noticed}");
}

#[test]
fn a_posture_beside_a_solution_has_no_box() {
    let mut draw = Random::new(2103);
    let mut refused = 0;
    for _ in 0..500 {
        let machine = draw.machine_of_any_kind();
        let question = draw.question(&machine);
        let Some(found) = postures(&question, &machine, Scope::All) else { continue };
        let unit = scale(&machine);
        for posture in found.iter().filter(|posture| !posture.merged) {
            let mut beside = *posture;
            // In the inverse problem z is given, and alpha is found.
            match question {
                Question::Forward(_) => beside.pose.x += 1e-4 * unit,
                _ => beside.pose.alpha += 1e-4,
            }
            let proof = question.certify(&machine, &[beside], Scope::All);
            assert_eq!(proof.boxes[0], Err(Unproved::NearSingularity), "{question:?} to {machine:?}");
            assert_eq!(proof.complete, Err(Incomplete::Unproved));
            refused += 1;
        }
    }
    assert!(refused > 2_000, "{refused}");
}

#[test]
fn boxes_contain_the_postures_and_are_narrow() {
    let mut draw = Random::new(2104);
    let (mut narrow, mut proved, mut all) = (0, 0, 0);
    for _ in 0..2_000 {
        let machine = draw.machine_of_any_kind();
        let question = draw.question(&machine);
        let Some(found) = postures(&question, &machine, Scope::All) else { continue };
        let proof = question.certify(&machine, &found, Scope::All);
        for (posture, of) in found.iter().zip(&proof.boxes) {
            all += 1;
            match of {
                Ok(of) => {
                    assert!(is_inside(of, coordinates(posture), |_| 0.0), "{question:?} to {machine:?}");
                    proved += 1;
                    let widest = bounds(of).iter().map(|[low, high]| high - low).fold(0.0, f64::max);
                    narrow += u32::from(widest < 1e-11 * scale(&machine));
                }
                Err(reason) => assert_eq!(*reason == Unproved::Merged, posture.merged),
            }
        }
    }
    // One question in five is next to where solutions merge.
    assert!(proved > all * 99 / 100 && narrow > all * 97 / 100, "{narrow} {proved} {all}");
}

#[test]
fn merged_solutions_are_not_proved() {
    // Leg I level: both sides of the leg are one.
    let machine = Machine::verne();
    let g = machine.data().geometry;
    let reach = (g.L2 * g.L2 - (g.R2 - g.r4).powi(2)).sqrt();
    let p = [reach - (g.D2 - g.d2), 0.0, 1000.0];
    let found = platform(&machine, p).unwrap();
    let merged = found.iter().filter(|posture| posture.merged).count();
    let proof = certify_platform(&machine, p, &found, Scope::All);
    assert!(merged > 0 && proof.complete == Err(Incomplete::Unproved), "{found:#?}");
    for (posture, of) in found.iter().zip(&proof.boxes) {
        assert_eq!(of.is_err(), posture.merged, "{posture:?}");
    }
}

#[test]
fn a_curve_of_solutions_is_not_proved() {
    let machine = proportional_machine::machine();
    let rho = [300.0; 3];
    assert_eq!(forward(&machine, rho), Err(KinematicsError::SelfMotion));
    for scope in [Scope::All, Scope::Working] {
        assert_eq!(certify_forward(&machine, rho, &[], scope).complete, Err(Incomplete::Undecided));
    }
}

#[test]
fn boxes_hold_for_every_orientation_within_bounds() {
    let mut draw = Random::new(2105);
    let mut checked = 0;
    for _ in 0..300 {
        let machine = draw.any_machine();
        let length = draw.tool_length(&machine);
        let target = draw.part_pose(&machine, length);
        let Ok(found) = part(&machine, &target, length) else { continue };
        let reach = 1e-12;
        let around = |angle: f64| [angle - reach, angle + reach];
        let orientation = EnclosedOrientation::within(around(target.phi1), around(target.phi2)).unwrap();
        let point = [target.x, target.y, target.z];
        let proof = certify_part(&machine, point, &orientation, length, &found, Scope::All);
        if proof.complete.is_err() {
            continue;
        }
        let turned = |by: f64| draw.between(-by, by);
        let mut turned = turned;
        let moved =
            PartPose { phi1: target.phi1 + turned(reach), phi2: target.phi2 + turned(reach), ..target };
        let Ok(others) = part(&machine, &moved, length) else { panic!("{moved:?} of {machine:?}") };
        let boxes = boxes(&proof);
        let error = |number: f64| 1e-13 * (number.abs() + scale(&machine));
        for posture in &others {
            let hits = boxes.iter().filter(|of| is_inside(of, coordinates(posture), error)).count();
            assert!(hits == 1, "{hits} of {posture:?} in {boxes:#?}");
        }
        checked += 1;
    }
    assert!(checked > 150, "{checked}");
}
