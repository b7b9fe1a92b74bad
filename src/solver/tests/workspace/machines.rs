//! Machines and requests of the tests.

use verne_solver::workspace::{Kind, Request};
use verne_solver::{Machine, MachineData};

pub(crate) fn request(kind: Kind, tool_length: f64, phi1: f64, tolerance: f64) -> Request {
    Request { tool_length, phi1: phi1.to_radians(), ..Request::new(kind, tolerance) }
}

/// The same request with the table as a limit.
pub(crate) fn above(least: f64, tool_radius: f64, request: Request) -> Request {
    Request { table_clearance: Some(least), tool_radius, ..request }
}

pub(crate) fn changed(change: impl FnOnce(&mut MachineData)) -> Machine {
    let mut data = Machine::verne().data().clone();
    change(&mut data);
    Machine::new(data).unwrap()
}

/// Pseudo-random numbers in [0, 1): xorshift.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

/// Machines unlike the reference machine, each in a different way.
pub(crate) fn others() -> Vec<(&'static str, Machine)> {
    vec![
        ("thick rods", changed(|data| data.geometry.rod_radius = 60.0)),
        (
            "thick rods on unlike legs",
            changed(|data| {
                let g = &mut data.geometry;
                (g.d1, g.d2) = (617.0, -689.0);
                (g.R1, g.r1, g.R2, g.r4) = (253.0, 67.0, 152.0, 401.5);
                (g.L1, g.L2, g.L3) = (867.5, 1_014.5, 1_339.6);
                g.rod_radius = 66.74;
                data.limits.stroke = [[180.0, 717.0], [30.0, 401.0], [0.0, 750.0]];
            }),
        ),
        ("short strokes", changed(|data| data.limits.stroke = [[100.0, 400.0]; 3])),
        (
            "unequal strokes",
            changed(|data| data.limits.stroke = [[0.0, 500.0], [100.0, 700.0], [50.0, 650.0]]),
        ),
        (
            "unequal legs",
            changed(|data| {
                data.geometry.L2 = 1_150.0;
                data.geometry.L3 = 980.0;
            }),
        ),
        (
            "wide cones",
            changed(|data| {
                data.limits.slider_cone = 1.2;
                data.limits.platform_cone = 1.2;
            }),
        ),
        (
            "wide platform",
            changed(|data| {
                data.geometry.R1 = 320.0;
                data.geometry.R2 = 220.0;
                data.limits.serial_margin = 0.4;
            }),
        ),
    ]
}

/// Any machine, whether anything is feasible or not.
pub(crate) fn random(random: &mut Random) -> Option<Machine> {
    let mut data = Machine::verne().data().clone();
    let g = &mut data.geometry;
    if random.next() < 0.7 {
        for length in [&mut g.L1, &mut g.L2, &mut g.L3, &mut g.R1, &mut g.R2] {
            *length *= random.between(0.8, 1.3);
        }
        for length in [&mut g.r1, &mut g.r4, &mut g.d1, &mut g.d2] {
            *length *= random.between(0.6, 1.2);
        }
    }
    g.rod_radius = random.between(0.0, 70.0);
    for stroke in &mut data.limits.stroke {
        if random.next() < 0.6 {
            stroke[0] = random.between(0.0, 200.0);
            stroke[1] = stroke[0] + random.between(100.0, 700.0);
        }
    }
    if random.next() < 0.5 {
        data.limits.slider_cone = random.between(0.3, 1.5);
        data.limits.platform_cone = random.between(0.3, 1.5);
    }
    if random.next() < 0.4 {
        data.limits.serial_margin = random.between(0.0, 0.6);
        data.limits.parallel_margin = random.between(0.0, 0.1);
    }
    Machine::new(data).ok()
}

/// Any machine: dimensions up to e^1.4 times as large or as small as the reference machine's, cones of 30° to 180°,
/// rods of 5 to 90 mm.
pub(crate) fn spread(random: &mut Random) -> Option<Machine> {
    let mut data = Machine::verne().data().clone();
    let spread = random.between(0.2, 1.4);
    let g = &mut data.geometry;
    for length in [
        &mut g.D1,
        &mut g.d1,
        &mut g.D2,
        &mut g.d2,
        &mut g.R1,
        &mut g.r1,
        &mut g.R2,
        &mut g.r4,
        &mut g.L1,
        &mut g.L2,
        &mut g.L3,
        &mut g.parallelogram_half_width,
    ] {
        *length *= random.between(-spread, spread).exp();
    }
    g.rod_radius = random.between(5.0, 90.0);
    let limits = &mut data.limits;
    for stroke in &mut limits.stroke {
        stroke[1] *= random.between(-spread, spread).exp();
    }
    limits.slider_cone = random.between(30.0, 180.0).to_radians();
    limits.platform_cone = random.between(30.0, 180.0).to_radians();
    limits.serial_margin = random.between(-0.1, 0.4).max(0.0);
    Machine::new(data).ok()
}
