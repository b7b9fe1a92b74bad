//! Continuous batches: preimages, windings, the pole, jumps.

use std::f64::consts::TAU;

use serde_json::{Value, from_slice, json};

use super::answer_ik_batch;
use crate::operations::forward_batch::answer_fk_batch;
use crate::operations::machine_registry::MachineRegistry;

const ROWS: usize = 20_000;

fn bytes(mut request: Value) -> Vec<u8> {
    request["tool_length"] = json!(100);
    answer_ik_batch(request.to_string().as_bytes(), &MachineRegistry::default(), ROWS).unwrap()
}

/// `start` of joints in a row of an answer.
fn start_of(joints: &Value) -> Value {
    json!({"rho": [joints[0], joints[1], joints[2]], "theta1": joints[3], "theta2": joints[4]})
}

fn continuous(poses: &[Vec<f64>], start: Option<&Value>) -> Value {
    let mut request = json!({"poses": poses, "continuous": true});
    if let Some(start) = start {
        request["start"] = start_of(start);
    }
    from_slice(&bytes(request)).unwrap()
}

/// theta1 and theta2 of each row.
fn table(answer: &Value) -> Vec<[f64; 2]> {
    let joints = answer["joints"].as_array().unwrap();
    joints.iter().map(|row| [row[3].as_f64().unwrap(), row[4].as_f64().unwrap()]).collect()
}

/// The axis of phi1 and phi2, degrees.
fn axis(phi1: f64, phi2: f64) -> [f64; 3] {
    verne_solver::axis::tool_axis(phi1.to_radians(), phi2.to_radians())
}

fn row(tip: [f64; 3], axis: [f64; 3]) -> Vec<f64> {
    tip.into_iter().chain(axis).collect()
}

/// A row at a usual place.
fn tilted(phi1: f64, phi2: f64) -> Vec<f64> {
    row([60.0, 20.0, 300.0], axis(phi1, phi2))
}

/// Asserts that /fk returns tip and axis of each row.
fn assert_forward_returns(rows: &[Vec<f64>], answer: &Value) {
    let request = json!({"joints": answer["joints"], "tool_length": 100, "orientation": "vector"});
    let text = answer_fk_batch(request.to_string().as_bytes(), &MachineRegistry::default(), ROWS).unwrap();
    let parts: Value = from_slice::<Value>(&text).unwrap()["parts"].clone();
    for (row, part) in rows.iter().zip(parts.as_array().unwrap()) {
        let length = row[3].hypot(row[4]).hypot(row[5]);
        for i in 0..6 {
            let (wanted, bound) = if i < 3 { (row[i], 1e-9) } else { (row[i] / length, 2e-6) };
            assert!((part[i].as_f64().unwrap() - wanted).abs() < bound, "{row:?} {part}");
        }
    }
}

/// The joints of a pose on the preimage with phi1 and phi2, degrees.
fn joints_at(phi1: f64, phi2: f64) -> Value {
    let row = [60.0, 20.0, 300.0, phi1, phi2];
    let answer: Value = from_slice(&bytes(json!({"poses": [row]}))).unwrap();
    answer["joints"][0].clone()
}

#[test]
fn theta2_crosses_half_a_turn_without_a_jump() {
    let azimuths: Vec<f64> = (0..=40).map(|i| 170.0 + 0.5 * f64::from(i)).collect();
    let rows: Vec<_> = azimuths.iter().map(|azimuth| tilted(20.0, *azimuth)).collect();
    let answer = continuous(&rows, Some(&joints_at(20.0, 170.0)));
    assert_eq!(answer["jumps"], 0, "{answer}");
    assert_eq!(answer["counts"]["ok"], rows.len());
    for ([_, theta2], azimuth) in table(&answer).iter().zip(&azimuths) {
        assert!((theta2 + azimuth).abs() < 1e-9, "{theta2} at {azimuth}");
    }
    assert_forward_returns(&rows, &answer);
    // Angles of a program are not continuous there; they state the same axes.
    let reduced = azimuths.iter().map(|azimuth| if *azimuth > 180.0 { azimuth - 360.0 } else { *azimuth });
    let by_angles: Vec<_> = reduced.map(|azimuth| vec![60.0, 20.0, 300.0, 20.0, azimuth]).collect();
    let answer = continuous(&by_angles, Some(&joints_at(20.0, 170.0)));
    assert_eq!(answer["jumps"], 0);
    for ([_, theta2], azimuth) in table(&answer).iter().zip(&azimuths) {
        assert_eq!(*theta2, -azimuth);
    }
}

#[test]
fn several_turns_jump_only_at_the_end_of_the_rotary_range() {
    let azimuths: Vec<f64> = (0..=80).map(|i| 10.0 * f64::from(i)).collect();
    let rows: Vec<_> = azimuths.iter().map(|azimuth| tilted(20.0, *azimuth)).collect();
    let answer = continuous(&rows, Some(&joints_at(20.0, 0.0)));
    // theta2 = -azimuth as far as -360; the next row cannot continue.
    let jump = answer["jump"].as_array().unwrap();
    let first = jump.iter().position(|jump| *jump == true).unwrap();
    assert_eq!(first, 37, "{answer}");
    let theta = table(&answer);
    for (i, pair) in theta.windows(2).enumerate() {
        let turn = (pair[1][1] - pair[0][1]).abs();
        if jump[i + 1] == false {
            assert!((turn - 10.0).abs() < 1e-9, "row {i}");
        }
    }
    assert_eq!(answer["jumps"], jump.iter().filter(|jump| **jump == true).count());
    assert_forward_returns(&rows, &answer);
}

#[test]
fn without_a_start_the_first_row_turns_least() {
    for (phi1, phi2, theta2) in [(20.0, 170.0, 10.0), (20.0, 30.0, -30.0), (-20.0, 30.0, -30.0)] {
        let answer = continuous(&[tilted(phi1, phi2)], None);
        assert!((table(&answer)[0][1] - theta2).abs() < 1e-9, "{answer}");
        assert_eq!(answer["jump"], json!([false]));
    }
    // Both preimages turn by 90°: phi1 = alpha - theta1 >= 0 decides.
    for phi2 in [90.0, 90.0 + 1e-12, 90.0 - 1e-12, -90.0, -90.0 + 1e-12, -90.0 - 1e-12] {
        for phi1 in [20.0, -20.0] {
            let [theta1, theta2] = table(&continuous(&[tilted(phi1, phi2)], None))[0];
            let by_axis: Value = from_slice(&bytes(json!({"poses": [tilted(phi1, phi2)]}))).unwrap();
            assert_eq!(table(&by_axis)[0], [theta1, theta2], "a row by itself is like a first row");
            assert!((theta2 + phi2 * phi1.signum()).abs() < 1e-9 && theta1 < 0.0, "{phi1} {phi2}: {theta2}");
        }
    }
}

#[test]
fn at_the_pole_theta2_stays_and_the_sign_of_phi1_may_change() {
    let vertical = row([60.0, 20.0, 300.0], [0.0, 0.0, 1.0]);
    let noisy = row([61.0, 20.0, 300.0], [1e-7, -1e-7, 1.0]);
    let by_angles = vec![62.0, 20.0, 300.0, 0.0, 70.0];
    let rows = vec![tilted(5.0, 40.0), vertical.clone(), noisy, by_angles, tilted(-5.0, 40.0)];
    let answer = continuous(&rows, Some(&joints_at(5.0, 40.0)));
    for [_, theta2] in table(&answer) {
        assert!((theta2 + 40.0).abs() < 1e-9, "{answer}");
    }
    assert_eq!(answer["jumps"], 0);
    // The way from axis to axis leads over the pole.
    for noise in [0.0, 1e-6, -1e-6, 1e-9] {
        let rows = [tilted(5.0, 40.0), tilted(5.0, 220.0 + noise)];
        let answer = continuous(&rows, Some(&joints_at(5.0, 40.0)));
        assert!((table(&answer)[1][1] + 40.0).abs() < 1e-5, "{answer}");
        assert_eq!(answer["jumps"], 0);
    }
    // From the pole the preimage that turns less.
    let rows = [vertical, tilted(20.0, 170.0)];
    let answer = continuous(&rows, None);
    assert!((table(&answer)[1][1] - 10.0).abs() < 1e-9, "{answer}");
    assert_eq!(answer["jumps"], 0);
    assert_forward_returns(&rows, &answer);
}

#[test]
fn rounding_of_an_axis_chooses_no_other_branch() {
    let tips: Vec<[f64; 3]> = (0..20).map(|i| [5.0 * f64::from(i) - 50.0, 20.0, 300.0]).collect();
    for axis in [[0.0, 0.3, 1.0], [0.0, -0.3, 1.0], [0.3, 0.0, 1.0], [-0.3, 0.0, 1.0], [0.0, 0.0, 1.0]] {
        let exact: Vec<_> = tips.iter().map(|tip| row(*tip, axis)).collect();
        let noisy = tips.iter().enumerate().map(|(i, tip)| {
            let noise = [-0.0, 1e-17, -1e-17, 1e-11, -1e-11][i % 5];
            row(*tip, axis.map(|component| if component == 0.0 { noise } else { component }))
        });
        let noisy: Vec<_> = noisy.collect();
        for start in [None, Some(json!([400, 500, 500, 0, 0])), Some(json!([400, 500, 500, 10, 180]))] {
            let [exact, noisy] = [&exact, &noisy].map(|rows| continuous(rows, start.as_ref()));
            assert_eq!(exact["jump"], noisy["jump"], "{axis:?}");
            for (a, b) in table(&exact).iter().zip(table(&noisy)) {
                assert!((a[0] - b[0]).abs() < 1e-6 && (a[1] - b[1]).abs() < 1e-6, "{axis:?} {a:?} {b:?}");
            }
        }
    }
}

#[test]
fn a_whole_turn_apart_is_not_the_same() {
    let start = |theta2: f64| {
        let mut joints = joints_at(20.0, 180.0);
        joints[4] = json!(theta2);
        joints
    };
    for theta2 in [180.0, -180.0] {
        let answer = continuous(&[tilted(20.0, 180.0)], Some(&start(theta2)));
        assert!((table(&answer)[0][1] - theta2).abs() < 1e-9, "{answer}");
        assert_eq!(answer["jumps"], 0);
    }
}

/// A closed curve of axes that stays away from the pole, and of tips; `t` from 0 to 1.
fn smooth(t: f64, seed: f64) -> Vec<f64> {
    let wave = |k: f64| (TAU * t * (1.0 + (seed * k).fract() * 2.0) + 9.0 * seed * k).sin();
    let tip = [100.0 * wave(1.7), 80.0 * wave(2.3), 300.0 + 40.0 * wave(3.1)];
    row(tip, axis(14.0 + 5.0 * wave(4.3), 120.0 * wave(5.9)).map(|component| 3.0 * component))
}

#[test]
fn along_a_smooth_path_the_joints_change_no_more_than_the_path() {
    for seed in (1..=40).map(|i| f64::from(i) * 0.618_033_988_75) {
        let rows: Vec<_> = (0..400).map(|i| smooth(f64::from(i) / 400.0, seed)).collect();
        // phi1 of the start has the sign of the curve's, and the range has room on both sides.
        let first = continuous(&rows[..1], None);
        let answer = continuous(&rows, Some(&first["joints"][0]));
        assert_eq!(answer["jumps"], 0, "{seed}");
        for (pair, rows) in table(&answer).windows(2).zip(rows.windows(2)) {
            let turned = (0..3).map(|i| (rows[1][3 + i] - rows[0][3 + i]) / 3.0);
            let turned = turned.map(|change| change * change).sum::<f64>().sqrt().to_degrees();
            // The least inclination is 9°: theta2 turns by at most 1 / sin 9° times the axis.
            assert!((pair[1][1] - pair[0][1]).abs() <= 7.0 * turned + 1e-9, "{seed} {pair:?} {turned}");
        }
        assert_forward_returns(&rows, &answer);
    }
}

#[test]
fn rows_without_a_solution_interrupt_nothing() {
    let rows =
        json!([tilted(20.0, 170.0), null, [1e4, 0, 0, 0, 0, 1], [1, 2, 3, 0, 0, 0], tilted(20.0, 190.0)]);
    let start = start_of(&joints_at(20.0, 170.0));
    let request = json!({"poses": rows, "continuous": true, "start": start});
    let answer: Value = from_slice(&bytes(request)).unwrap();
    assert_eq!(answer["status"], json!(["ok", "invalid", "unreachable", "invalid", "ok"]));
    assert_eq!(answer["jump"], json!([false, null, null, null, false]));
    assert!((answer["joints"][4][4].as_f64().unwrap() + 190.0).abs() < 1e-9);
    assert_eq!(answer["errors"][1]["detail"], "the axis [i, j, k] must not be zero");
}

#[test]
fn the_answer_does_not_depend_on_the_number_of_threads() {
    let mut rows: Vec<_> = (0..9000).map(|i| smooth(f64::from(i) / 9000.0, 0.4)).collect();
    for i in (0..9000).filter(|i| i / 700 % 3 == 1) {
        rows[i].truncate(3);
        rows[i].extend([0.0, 0.0, 1.0]);
    }
    let [one, four] = [1, 4].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| bytes(json!({"poses": rows, "continuous": true})))
    });
    assert!(one == four);
}
