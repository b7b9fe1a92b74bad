//! The derivatives by a machine's parameters against differences of the forward solution, and laws that they obey.

use verne_solver::jacobian::{ToolJacobian, velocities};
use verne_solver::machine::{Geometry, Table};
use verne_solver::parameter::{
    ActualMachine, MACHINE_FRAME_PARAMETERS, PARAMETERS, Parameter, ParameterUnit, ToolFrame,
};
use verne_solver::{Machine, PlatformPose, TableAngles, forward_working, part_pose};

use crate::lengths::scale;
use crate::machines::{changed, random};
use crate::oracle::constructed_postures::postures;
use crate::random::Random;

/// A machine in a posture, and the angles of its table.
struct Case {
    machine: ActualMachine,
    rho: [f64; 3],
    pose: PlatformPose,
    table: TableAngles,
    /// The machine's size, mm.
    size: f64,
}

impl Case {
    /// A machine whose parameters are off by up to `spread`, relative to its size or in radians.
    fn new(nominal: &Machine, rho: [f64; 3], spread: f64, draw: &mut Random) -> Option<Self> {
        let size = scale(nominal);
        let changes: Vec<_> =
            Parameter::ALL.into_iter().map(|p| (p, unit(p, size) * draw.between(-spread, spread))).collect();
        let machine = ActualMachine::new(nominal, size * draw.between(0.0, 0.3)).with(changes);
        let table = TableAngles { theta1: draw.between(-1.2, 1.2), theta2: draw.between(-3.0, 3.0) };
        let pose = machine.platform(rho).ok()?;
        Some(Self { machine, rho, pose, table, size })
    }

    fn frames(&self) -> [ToolFrame; 2] {
        [ToolFrame::Machine, ToolFrame::Part(self.table)]
    }

    /// Coordinates of the platform, then of the tool's end and axis in the frame, with one parameter changed.
    fn coordinates(&self, parameter: Parameter, change: f64, frame: ToolFrame) -> Option<[f64; 10]> {
        let machine = self.machine.with([(parameter, change)]);
        let pose = machine.platform_near(&self.pose, self.rho)?;
        let tool = machine.tool(&pose, frame);
        let [a, b, c] = tool.tip;
        let [i, j, k] = tool.axis;
        Some([pose.x, pose.y, pose.z, pose.alpha, a, b, c, i, j, k])
    }

    /// Differences of sixth order.
    fn differences(&self, parameter: Parameter, step: f64, frame: ToolFrame) -> Option<[f64; 10]> {
        let at = |times: f64| self.coordinates(parameter, times * step, frame);
        let values = [at(-3.0)?, at(-2.0)?, at(-1.0)?, at(1.0)?, at(2.0)?, at(3.0)?];
        let weights = [-1.0, 9.0, -45.0, 45.0, -9.0, 1.0].map(|weight| weight / (60.0 * step));
        Some(std::array::from_fn(|i| {
            values.iter().zip(weights).map(|(value, weight)| value[i] * weight).sum()
        }))
    }

    fn rates(&self, frame: ToolFrame) -> [[f64; 10]; PARAMETERS] {
        let platform = self.machine.platform_rates(&self.pose, self.rho).unwrap();
        let tool = self.machine.tool_rates(&self.pose, self.rho, frame).unwrap();
        std::array::from_fn(|p| {
            let [x, y, z, alpha] = platform[p];
            let ([a, b, c], [i, j, k]) = (tool.tip[p], tool.axis[p]);
            [x, y, z, alpha, a, b, c, i, j, k]
        })
    }

    /// Compares all derivatives with differences of two steps. The answer is false where these do not agree.
    fn is_checked(&self, tolerance: f64) -> bool {
        let lengths = [1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0];
        let units = lengths.map(|is_length| if is_length > 0.0 { self.size } else { 1.0 });
        for frame in self.frames() {
            for (parameter, rates) in Parameter::ALL.into_iter().zip(self.rates(frame)) {
                let unit = unit(parameter, self.size);
                let both = [1e-4, 2e-4].map(|step| self.differences(parameter, step * unit, frame));
                let [Some(found), Some(coarse)] = both else { return false };
                let size = (0..10).fold(1e-3_f64, |size, i| size.max((rates[i] * unit / units[i]).abs()));
                let is_off = |a: f64, b: f64, i: usize| (a - b).abs() * unit / units[i] > tolerance * size;
                if (0..10).any(|i| is_off(found[i], coarse[i], i)) {
                    return false;
                }
                for i in 0..10 {
                    let holds = !is_off(found[i], rates[i], i);
                    assert!(holds, "{parameter:?}, {frame:?}, coordinate {i}: {rates:?}, {found:?}");
                }
            }
        }
        true
    }
}

/// A change of a parameter that is comparable to one of another parameter.
fn unit(parameter: Parameter, size: f64) -> f64 {
    if parameter.unit() == ParameterUnit::Millimetre { size } else { 1.0 }
}

fn reference_cases(seed: u64, count: usize, spread: f64) -> Vec<Case> {
    let mut draw = Random::new(seed);
    let machine = Machine::verne();
    let mut cases = Vec::new();
    while cases.len() < count {
        let rho = [0, 1, 2].map(|_| draw.between(50.0, 700.0));
        cases.extend(Case::new(&machine, rho, spread, &mut draw));
    }
    cases
}

fn random_cases(seed: u64, wanted: usize) -> Vec<Case> {
    let mut draw = Random::new(seed);
    let regular = postures(seed, wanted).into_iter().filter(|(machine, found)| {
        found.working && found.amplification < 30.0 && scale(machine) < 20.0 * machine.data().geometry.R1
    });
    let mut cases: Vec<Case> =
        regular.filter_map(|(machine, found)| Case::new(&machine, found.rho, 1e-3, &mut draw)).collect();
    for _ in 0..200 {
        let Some(machine) = random(&mut draw) else { continue };
        let rho = [0, 1, 2].map(|_| draw.between(100.0, 600.0));
        cases.extend(Case::new(&machine, rho, 1e-3, &mut draw));
    }
    cases
}

#[test]
fn derivatives_equal_central_differences_within_a_millionth() {
    let checked = reference_cases(2101, 150, 1e-3).iter().filter(|case| case.is_checked(1e-7)).count();
    assert!(checked > 130, "{checked}");
    let cases = random_cases(2102, 2000);
    let checked = cases.iter().filter(|case| case.is_checked(1e-7)).count();
    assert!(checked > 150, "{checked} of {}", cases.len());
}

#[test]
fn derivatives_of_a_linear_delta_equal_central_differences() {
    let mut draw = Random::new(2103);
    let delta = changed(|data| data.geometry.r1 = data.geometry.R1);
    let mut checked = 0;
    for _ in 0..60 {
        let rho = [0, 1, 2].map(|_| draw.between(100.0, 600.0));
        // Without changes: leg I is a parallelogram. With R1 < r1 it is no machine, but a mechanism still.
        let Some(case) = Case::new(&delta, rho, 0.0, &mut draw) else { continue };
        assert!(case.pose.alpha.abs() < 1e-15);
        let turn = case.machine.platform_rates(&case.pose, rho).unwrap()[Parameter::R1.index()][3];
        assert!(turn.abs() > 1e-9, "unequal distances turn the platform");
        checked += usize::from(case.is_checked(1e-7));
    }
    assert!(checked > 30, "{checked}");
}

#[test]
fn a_changed_machine_has_the_forward_solution_of_the_actual_one() {
    let mut checked = 0;
    for case in reference_cases(2104, 100, 2e-3).into_iter().chain(random_cases(2105, 500)) {
        let Ok(machine) = case.machine.machine() else { continue };
        let offsets = [Parameter::o1, Parameter::o2, Parameter::o3].map(|offset| case.machine.value(offset));
        let rho = [0, 1, 2].map(|i| case.rho[i] + offsets[i]);
        let Ok(found) = forward_working(&machine, rho) else { continue };
        let distance = [found.pose.x - case.pose.x, found.pose.y - case.pose.y, found.pose.z - case.pose.z];
        assert!(distance.iter().all(|part| part.abs() < 1e-9 * case.size), "{distance:?}");
        assert!((found.pose.alpha - case.pose.alpha).abs() < 1e-9);
        checked += 1;
    }
    assert!(checked > 200, "{checked}");
}

#[test]
fn without_changes_the_tool_is_where_the_nominal_machine_has_it() {
    for case in reference_cases(2106, 100, 0.0) {
        let length = case.machine.value(Parameter::ToolLength);
        let nominal = part_pose(&Machine::verne(), &case.pose, case.table, length);
        let tool = case.machine.tool(&case.pose, ToolFrame::Part(case.table));
        let ([s1, c1], [s2, c2]) =
            ([nominal.phi1.sin(), nominal.phi1.cos()], [nominal.phi2.sin(), nominal.phi2.cos()]);
        let expected = [nominal.x, nominal.y, nominal.z, s1 * s2, -s1 * c2, c1];
        for (found, expected) in tool.tip.into_iter().chain(tool.axis).zip(expected) {
            assert!((found - expected).abs() < 1e-10, "{tool:?}, {nominal:?}");
        }
    }
}

#[test]
fn zero_offsets_act_as_the_joints_do() {
    for case in reference_cases(2107, 100, 0.0) {
        let nominal = Machine::verne();
        let posture = forward_working(&nominal, case.rho).unwrap();
        let length = case.machine.value(Parameter::ToolLength);
        let jacobian = ToolJacobian::of(&nominal, &posture, case.table, length).unwrap().matrix();
        let rates = case.rates(ToolFrame::Part(case.table));
        let sliders = velocities(&nominal, &posture).unwrap();
        let offsets =
            [Parameter::o1, Parameter::o2, Parameter::o3, Parameter::TiltZero, Parameter::RotaryZero];
        for (joint, offset) in offsets.into_iter().enumerate() {
            let found = rates[offset.index()];
            for axis in 0..3 {
                assert!((found[4 + axis] - jacobian[axis][joint]).abs() < 1e-9 * case.size, "{offset:?}");
            }
            for row in 0..if joint < 3 { 4 } else { 0 } {
                assert!((found[row] - sliders[row][joint]).abs() < 1e-10, "{offset:?}");
            }
        }
    }
}

/// All lengths and the sliders grow by one factor: positions grow with them, angles stay (Euler's theorem).
#[test]
fn lengths_times_derivatives_sum_to_the_position() {
    for case in random_cases(2108, 500) {
        for frame in case.frames() {
            let rates = case.rates(frame);
            let tool = case.machine.tool(&case.pose, frame);
            let mut sum = [0.0; 10];
            let mut largest = 1.0_f64;
            for (parameter, rates) in Parameter::ALL.into_iter().zip(rates) {
                if parameter.unit() == ParameterUnit::Radian {
                    continue;
                }
                let rho = match parameter {
                    Parameter::o1 => case.rho[0],
                    Parameter::o2 => case.rho[1],
                    Parameter::o3 => case.rho[2],
                    _ => 0.0,
                };
                let value = (case.machine.value(parameter) + rho) / case.size;
                for (sum, rate) in sum.iter_mut().zip(rates) {
                    *sum += value * rate;
                    largest = largest.max((value * rate).abs());
                }
            }
            let [a, b, c] = tool.tip;
            let expected =
                [case.pose.x, case.pose.y, case.pose.z, 0.0, a, b, c, 0.0, 0.0, 0.0].map(|v| v / case.size);
            for (i, (sum, expected)) in sum.into_iter().zip(expected).enumerate() {
                assert!((sum - expected).abs() < 1e-9 * largest, "coordinate {i}: {sum}, {expected}");
            }
        }
    }
}

#[test]
fn a_common_shift_of_both_offsets_moves_the_platform_back() {
    for case in reference_cases(2109, 50, 1e-3) {
        let rates = case.machine.platform_rates(&case.pose, case.rho).unwrap();
        let [first, second] = [Parameter::e1, Parameter::e2].map(|offset| rates[offset.index()]);
        let sum: [f64; 4] = std::array::from_fn(|i| first[i] + second[i]);
        let expected = [-1.0, 0.0, 0.0, 0.0];
        assert!(sum.iter().zip(expected).all(|(sum, expected)| (sum - expected).abs() < 1e-9), "{sum:?}");
    }
}

#[test]
fn the_table_does_not_matter_in_the_machine_frame() {
    for case in reference_cases(2110, 20, 1e-3) {
        let rates = case.rates(ToolFrame::Machine);
        assert!(rates[MACHINE_FRAME_PARAMETERS..].iter().flatten().all(|rate| *rate == 0.0));
    }
}

#[test]
fn the_axis_turns_at_right_angles_to_itself() {
    for case in random_cases(2111, 200) {
        for frame in case.frames() {
            let axis = case.machine.tool(&case.pose, frame).axis;
            for rates in case.machine.tool_rates(&case.pose, case.rho, frame).unwrap().axis {
                let along: f64 = axis.iter().zip(rates).map(|(a, b)| a * b).sum();
                let size = rates.iter().fold(1e-9_f64, |size, rate| size.max(rate.abs()));
                assert!(along.abs() < 1e-12 * size.max(1.0), "{along}");
            }
        }
    }
}

#[test]
fn at_a_parallel_singularity_there_are_no_derivatives() {
    let delta = changed(|data| data.geometry.r1 = data.geometry.R1);
    let g: Geometry = delta.data().geometry;
    // Leg I is level: w1 = 0.
    let pose = PlatformPose { x: g.L1 - (g.D1 - g.d1), y: 0.0, z: 1000.0, alpha: 0.0 };
    let machine = ActualMachine::new(&delta, 0.0);
    assert_eq!(machine.platform_rates(&pose, [1000.0, 500.0, 500.0]), None);
}

#[test]
fn the_machine_of_changed_parameters_states_them() {
    let changes: Vec<_> =
        Parameter::ALL.into_iter().zip(1_u8..).map(|(p, i)| (p, 0.01 * f64::from(i))).collect();
    let machine = ActualMachine::new(&Machine::verne(), 50.0).with(changes.clone());
    for (parameter, change) in changes {
        assert_eq!(machine.change(parameter), change);
        assert_eq!(Parameter::named(parameter.name()), Some(parameter));
    }
    let data = machine.machine().unwrap().data().clone();
    assert_eq!((data.geometry.D1, data.geometry.d1, data.geometry.D2), (100.01, 600.0, -100.0 + 0.02));
    assert_eq!(data.table, Table { da: 1500.0 + 0.01 * 14.0, dt: 200.0 + 0.01 * 15.0 });
    assert_eq!(data.limits, Machine::verne().data().limits);
}
