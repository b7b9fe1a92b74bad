//! Machines: the built-in one with changes, similar ones, and random ones.

#![allow(dead_code, reason = "each test takes the machines that it wants")]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends without a machine")]

use std::f64::consts::PI;

use verne_solver::machine::{Geometry, Limits, Table};
use verne_solver::{Machine, MachineData};

use super::lengths::lengths;
use super::random::Random;

/// Relative differences from R1 = r1 and from e1 = e2.
const DIFFERENCES: [f64; 12] = [0.0, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 9e-3];

/// The built-in machine with a change.
pub(crate) fn changed(change: impl FnOnce(&mut MachineData)) -> Machine {
    let mut data = Machine::verne().data().clone();
    change(&mut data);
    Machine::new(data).unwrap()
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
    if random.fraction() < 0.7 {
        for length in [&mut g.L1, &mut g.L2, &mut g.L3, &mut g.R1, &mut g.R2] {
            *length *= random.between(0.8, 1.3);
        }
        for length in [&mut g.r1, &mut g.r4, &mut g.d1, &mut g.d2] {
            *length *= random.between(0.6, 1.2);
        }
    }
    g.rod_radius = random.between(0.0, 70.0);
    for stroke in &mut data.limits.stroke {
        if random.fraction() < 0.6 {
            stroke[0] = random.between(0.0, 200.0);
            stroke[1] = stroke[0] + random.between(100.0, 700.0);
        }
    }
    if random.fraction() < 0.5 {
        data.limits.slider_cone = random.between(0.3, 1.5);
        data.limits.platform_cone = random.between(0.3, 1.5);
    }
    if random.fraction() < 0.4 {
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
    for length in lengths(&mut data.geometry) {
        *length *= random.between(-spread, spread).exp();
    }
    data.geometry.rod_radius = random.between(5.0, 90.0);
    let limits = &mut data.limits;
    for stroke in &mut limits.stroke {
        stroke[1] *= random.between(-spread, spread).exp();
    }
    limits.slider_cone = random.between(30.0, 180.0).to_radians();
    limits.platform_cone = random.between(30.0, 180.0).to_radians();
    limits.serial_margin = random.between(-0.1, 0.4).max(0.0);
    Machine::new(data).ok()
}

/// A machine at a relative difference from R1 = r1, from e1 = e2, or from both.
pub(crate) fn near_the_edge(draw: &mut Random) -> Option<Machine> {
    let mut data = Machine::verne().data().clone();
    let g = &mut data.geometry;
    for length in [&mut g.L1, &mut g.L2, &mut g.L3, &mut g.R1, &mut g.r1, &mut g.R2, &mut g.r4] {
        *length *= draw.between(0.7, 1.3);
    }
    for offset in [&mut g.d1, &mut g.d2] {
        *offset *= draw.between(0.3, 1.2);
    }
    let difference = draw.pick(&DIFFERENCES);
    let kind = draw.pick(&[0, 1, 2]);
    if kind != 1 {
        g.R1 = g.r1 * (1.0 + difference);
    }
    if kind != 0 {
        g.d2 = g.D2 - (g.D1 - g.d1) + difference * g.L1;
    }
    Machine::new(data).ok()
}

impl Random {
    /// A valid machine of varied proportions and scale, from a millimetre to a hundred metres.
    pub(crate) fn machine(&mut self) -> Machine {
        for _ in 0..1000 {
            let scale = if self.one_in(2) { 1000.0 } else { self.magnitude(1.0, 1e5) };
            let geometry = self.geometry(scale);
            if let Ok(machine) = Machine::new(self.data(geometry, scale)) {
                return machine;
            }
        }
        panic!("no valid machine in a thousand");
    }

    #[allow(non_snake_case, reason = "the paper's symbols")]
    fn geometry(&mut self, scale: f64) -> Geometry {
        let R1 = self.between(0.03, 0.7);
        let L2 = self.between(0.6, 1.4);
        let offset = self.between(-1.0, 1.0);
        Geometry {
            D1: scale * self.between(-0.4, 0.4),
            d1: scale * self.between(-0.6, 0.6),
            D2: scale * (offset + self.between(-0.4, 0.4)),
            d2: scale * (offset + self.between(-0.6, 0.6)),
            R1: scale * R1,
            r1: scale * R1 * self.between(0.02, 0.95),
            R2: scale * (R1 * self.magnitude(0.1, 10.0)).min(1.5),
            r4: scale * self.between(0.03, 0.9),
            L1: scale * self.between(0.6, 1.4),
            L2: scale * L2,
            L3: scale * if self.one_in(2) { L2 } else { self.between(0.6, 1.4) },
            parallelogram_half_width: scale * self.between(0.01, 0.2),
            parallelogram_direction: 0.0,
            rod_radius: scale * self.between(0.0, 0.03),
        }
    }

    fn data(&mut self, geometry: Geometry, scale: f64) -> MachineData {
        MachineData {
            name: "random".into(),
            description: "A machine that nobody has built.".into(),
            geometry,
            table: Table { da: scale * self.between(-1.0, 2.0), dt: scale * self.between(-0.5, 0.5) },
            limits: Limits {
                stroke: [0, 1, 2].map(|_| [0.0, scale * self.between(0.2, 1.5)]),
                slider_cone: self.between(0.2, 1.2),
                platform_cone: self.between(0.2, 1.2),
                serial_margin: self.between(0.0, 0.3),
                parallel_margin: self.between(0.0, 0.1),
                tilt: [-self.between(0.5, PI), self.between(0.5, PI)],
                rotary: Some([-self.between(1.0, 6.3), self.between(1.0, 6.3)]),
                table_clearance: None,
                slider_axes: None,
                platform_axes: None,
            },
            drives: None,
        }
    }

    /// A machine: the built-in one or a random one.
    pub(crate) fn any_machine(&mut self) -> Machine {
        if self.one_in(3) { Machine::verne() } else { self.machine() }
    }
}
