//! The Jacobian of the whole machine against the forward and the inverse problem.

use verne_solver::jacobian::{Singularity, ToolJacobian};
use verne_solver::machine::{Drive, Drives};
use verne_solver::{Machine, PartPose, Posture, TableAngles, forward_working, part_pose, part_working};

use crate::lengths::scale;
use crate::machines::random;
use crate::oracle::Legs;
use crate::oracle::constructed_postures::postures;
use crate::random::Random;

/// Positions of all joints.
type Joints = [f64; 5];

/// A machine in a posture, with a tool.
struct Case {
    machine: Machine,
    posture: Posture,
    table: TableAngles,
    tool_length: f64,
}

impl Case {
    fn new(machine: Machine, posture: Posture, draw: &mut Random) -> Self {
        let table = TableAngles { theta1: draw.between(-1.2, 1.2), theta2: draw.between(-3.0, 3.0) };
        let tool_length = scale(&machine) * draw.between(0.0, 0.3);
        Self { machine, posture, table, tool_length }
    }

    fn joints(&self) -> Joints {
        let [a, b, c] = self.posture.rho;
        [a, b, c, self.table.theta1, self.table.theta2]
    }

    fn jacobian(&self) -> ToolJacobian {
        ToolJacobian::of(&self.machine, &self.posture, self.table, self.tool_length).unwrap()
    }

    /// The forward solution. `None` if it is not in the working mode, or in another solution.
    fn tool(&self, [a, b, c, theta1, theta2]: Joints) -> Option<PartPose> {
        let posture = forward_working(&self.machine, [a, b, c]).ok()?;
        let is_near = (posture.pose.alpha - self.posture.pose.alpha).abs() < 0.1;
        let table = TableAngles { theta1, theta2 };
        is_near.then(|| part_pose(&self.machine, &posture.pose, table, self.tool_length))
    }

    /// The rates of the tool with one joint: differences of sixth order.
    fn differences(&self, joint: usize, step: f64) -> Option<[f64; 5]> {
        let sine = self.tool(self.joints())?.phi1.sin();
        let at = |times: f64| {
            let mut joints = self.joints();
            joints[joint] += times * step;
            self.tool(joints).map(|pose| [pose.x, pose.y, pose.z, pose.phi1, sine * pose.phi2])
        };
        let values = [at(-3.0)?, at(-2.0)?, at(-1.0)?, at(1.0)?, at(2.0)?, at(3.0)?];
        let weights = [-1.0, 9.0, -45.0, 45.0, -9.0, 1.0].map(|weight| weight / (60.0 * step));
        Some(
            [0, 1, 2, 3, 4]
                .map(|i| values.iter().zip(weights).map(|(value, weight)| value[i] * weight).sum()),
        )
    }

    /// Compares the matrix with differences of two steps. The answer is false where these do not agree with each other.
    fn is_checked(&self, tolerance: f64) -> bool {
        let (length, matrix) = (scale(&self.machine), self.jacobian().matrix());
        for joint in 0..5 {
            let unit = if joint < 3 { length } else { 1.0 };
            let both = [1e-4, 2e-4].map(|step| self.differences(joint, step * unit));
            let [Some(found), Some(coarse)] = both else { return false };
            let units = [length, length, length, 1.0, 1.0];
            let scaled = |rates: &[f64; 5]| [0, 1, 2, 3, 4].map(|i| rates[i] * unit / units[i]);
            let column = scaled(&matrix.map(|row| row[joint]));
            let (found, coarse) = (scaled(&found), scaled(&coarse));
            let size = column.iter().fold(1e-3_f64, |size, rate| size.max(rate.abs()));
            if (0..5).any(|i| (found[i] - coarse[i]).abs() > 0.1 * tolerance * size) {
                return false;
            }
            for i in 0..5 {
                let error = (found[i] - column[i]).abs();
                assert!(error < tolerance * size, "row {i}, joint {joint}: {column:?}, {found:?}");
            }
        }
        true
    }
}

fn reference_cases(seed: u64, count: usize) -> Vec<Case> {
    let mut draw = Random::new(seed);
    let mut cases = Vec::new();
    while cases.len() < count {
        let rho = [0, 1, 2].map(|_| draw.between(50.0, 700.0));
        let Ok(posture) = forward_working(&Machine::verne(), rho) else { continue };
        cases.push(Case::new(Machine::verne(), posture, &mut draw));
    }
    cases
}

fn random_cases(seed: u64, wanted: usize) -> Vec<Case> {
    let mut draw = Random::new(seed);
    let regular = postures(seed, wanted).into_iter().filter(|(machine, found)| {
        let radius = Legs::of(machine).g.R1;
        found.working && found.amplification < 30.0 && scale(machine) < 20.0 * radius
    });
    let cases = regular.filter_map(|(machine, found)| {
        let posture = forward_working(&machine, found.rho).ok()?;
        Some(Case::new(machine, posture, &mut draw))
    });
    cases.collect()
}

fn drives(draw: &mut Random) -> Drives {
    let mut drive = |low, high| Drive { velocity: draw.magnitude(low, high), acceleration: None };
    Drives { slider: drive(10.0, 1e4), tilt: drive(0.1, 100.0), rotary: drive(0.1, 100.0) }
}

#[test]
fn the_matrix_equals_central_differences_of_the_forward_solution() {
    let checked = reference_cases(121, 500).iter().filter(|case| case.is_checked(1e-7)).count();
    assert!(checked > 450, "{checked}");
}

#[test]
fn the_matrix_of_random_machines_equals_central_differences() {
    let cases = random_cases(122, 4000);
    let checked = cases.iter().filter(|case| case.is_checked(1e-7)).count();
    assert!(checked > 300, "{checked} of {}", cases.len());
    let mut draw = Random::new(123);
    let similar = (0..300).filter_map(|_| {
        let machine = random(&mut draw)?;
        let posture = forward_working(&machine, [0, 1, 2].map(|_| draw.between(100.0, 600.0))).ok()?;
        Some(Case::new(machine, posture, &mut draw))
    });
    let checked = similar.filter(|case| case.is_checked(1e-7)).count();
    assert!(checked > 100, "{checked}");
}

/// The joints for the tool displaced along an axis, with the orientation as it is.
fn displaced(case: &Case, axis: usize, step: f64) -> Option<Joints> {
    let mut pose = case.tool(case.joints())?;
    *[&mut pose.x, &mut pose.y, &mut pose.z][axis] += step;
    let posture = part_working(&case.machine, &pose, case.tool_length).ok()?;
    let is_near = (posture.pose.alpha - case.posture.pose.alpha).abs() < 0.1;
    let [a, b, c] = posture.rho;
    is_near.then_some([a, b, c, posture.pose.alpha - pose.phi1, -pose.phi2])
}

/// The rates of the joints with the tool along an axis, by the inverse problem: differences of fourth order.
fn joint_rates(case: &Case, axis: usize, step: f64) -> Option<Joints> {
    let at = |times: f64| displaced(case, axis, times * step);
    let [a, b, c, d] = [at(-2.0)?, at(-1.0)?, at(1.0)?, at(2.0)?];
    Some([0, 1, 2, 3, 4].map(|i| (a[i] - 8.0 * b[i] + 8.0 * c[i] - d[i]) / (12.0 * step)))
}

#[test]
fn greatest_speeds_equal_the_ratios_of_the_drives_in_the_inverse_problem() {
    let mut checked = 0;
    let mut draw = Random::new(124);
    for case in reference_cases(125, 300).into_iter().chain(random_cases(126, 2000)) {
        let drives = drives(&mut draw);
        let velocities = drives.of_joints().map(|drive| drive.velocity);
        let Some(found) = case.jacobian().greatest_speeds(&drives) else { continue };
        for (axis, found) in found.into_iter().enumerate() {
            let both = [1e-5, 2e-5].map(|step| joint_rates(&case, axis, step * scale(&case.machine)));
            let [Some(rates), Some(coarse)] = both else { continue };
            let speed = |rates: &Joints, joint: usize| velocities[joint] / rates[joint].abs();
            let least = |rates| (0..5).map(|joint| speed(rates, joint)).fold(f64::INFINITY, f64::min);
            let expected = least(&rates);
            // Near a singularity the differences are not precise.
            if (least(&coarse) - expected).abs() > 1e-7 * expected {
                continue;
            }
            assert!((found.speed - expected).abs() < 1e-6 * expected, "{found:?}, {expected}");
            assert!((speed(&rates, found.joint) - expected).abs() < 1e-6 * expected, "{found:?}");
            checked += 1;
        }
    }
    assert!(checked > 800, "{checked}");
}

#[test]
fn tip_errors_equal_displacements_of_the_forward_solution() {
    let mut checked = 0;
    for case in reference_cases(127, 300).into_iter().chain(random_cases(128, 1000)) {
        let slider = 1e-6 * scale(&case.machine);
        let found = case.jacobian().tip_errors(slider, 1e-6);
        for (joint, found) in found.into_iter().enumerate() {
            let at = |times: f64| {
                let mut joints = case.joints();
                joints[joint] += times * if joint < 3 { slider } else { 1e-6 };
                case.tool(joints)
            };
            let [Some(low), Some(high)] = [at(-1.0), at(1.0)] else { continue };
            let way = [high.x - low.x, high.y - low.y, high.z - low.z];
            let expected = 0.5 * way.iter().map(|part| part * part).sum::<f64>().sqrt();
            assert!((found - expected).abs() < 1e-4 * expected.max(slider), "{found}, {expected}");
            checked += 1;
        }
    }
    assert!(checked > 1800, "{checked}");
}

#[test]
fn a_tool_along_the_axis_of_the_table_is_at_the_pole() {
    for case in reference_cases(129, 50) {
        let table = TableAngles { theta1: case.posture.pose.alpha, ..case.table };
        let upright = Case { table, ..case };
        let found = upright.jacobian();
        assert_eq!(found.singularities(), [Singularity::Pole]);
        assert_eq!(found.condition_number(300.0), None);
        assert!(found.singular_values(300.0).iter().all(|value| value.is_finite()));
        assert!(found.greatest_speeds(&drives(&mut Random::new(1))).is_some(), "theta2 stands still");
    }
}

#[test]
fn the_condition_number_is_the_ratio_of_singular_values_and_has_no_unit() {
    for case in reference_cases(130, 100) {
        let found = case.jacobian();
        let (values, number) = (found.singular_values(300.0), found.condition_number(300.0).unwrap());
        assert!((values[0] / values[4] - number).abs() <= 1e-12 * number);
        // The same machine in centimetres.
        let mut data = case.machine.data().clone();
        let g = &mut data.geometry;
        for length in crate::lengths::lengths(g) {
            *length *= 0.1;
        }
        data.table = verne_solver::machine::Table { da: 0.1 * data.table.da, dt: 0.1 * data.table.dt };
        data.limits.stroke = data.limits.stroke.map(|stroke| stroke.map(|end| 0.1 * end));
        let machine = Machine::new(data).unwrap();
        let posture = forward_working(&machine, case.posture.rho.map(|rho| 0.1 * rho)).unwrap();
        let small = Case { machine, posture, tool_length: 0.1 * case.tool_length, ..case };
        let other = small.jacobian().condition_number(30.0).unwrap();
        assert!((other - number).abs() < 1e-6 * number, "{other}, {number}");
    }
}
