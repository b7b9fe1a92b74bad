//! Random machines, poses and sliders, the same in every run.

use std::f64::consts::PI;

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use verne_solver::machine::{Geometry, Limits, Table};
use verne_solver::{Machine, MachineData, PartPose};

/// A stream of random inputs.
pub(crate) struct Draw(Xoshiro256PlusPlus);

impl Draw {
    /// The stream of a seed.
    pub(crate) fn seeded(seed: u64) -> Self {
        Self(Xoshiro256PlusPlus::seed_from_u64(seed))
    }

    /// Uniform in `[low, high)`.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0.random_range(low..high)
    }

    /// Uniform in its logarithm.
    pub(crate) fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    /// True in one of `n` draws.
    pub(crate) fn one_in(&mut self, n: u32) -> bool {
        self.0.random_ratio(1, n)
    }

    /// Any of the 2^64 patterns.
    pub(crate) fn bits(&mut self) -> u64 {
        self.0.random()
    }

    /// One of the values.
    pub(crate) fn pick<T: Copy>(&mut self, values: &[T]) -> T {
        values[self.0.random_range(0..values.len())]
    }

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
                rotary: [-self.between(1.0, 6.3), self.between(1.0, 6.3)],
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

    /// Slider positions anywhere within a few machine lengths, on any level.
    pub(crate) fn rho(&mut self, machine: &Machine) -> [f64; 3] {
        let scale = scale(machine);
        let (spread, level) = (self.between(0.05, 1.6), self.between(-1.0, 1.0));
        [0, 1, 2].map(|_| scale * (level + spread * self.between(-1.0, 1.0)))
    }

    /// A point around the machine, most of them within reach of its legs.
    pub(crate) fn point(&mut self, machine: &Machine) -> [f64; 3] {
        let g = &machine.data().geometry;
        let scale = scale(machine);
        let middle = -f64::midpoint(g.D1 - g.d1, g.D2 - g.d2);
        let reach = self.pick(&[0.2, 0.5, 1.0]);
        [
            middle + scale * reach * self.between(-0.8, 0.8),
            scale * reach * self.between(-0.8, 0.8),
            scale * self.between(0.0, 2.0),
        ]
    }

    /// A length of the tool, zero and longer than the machine's rods among them.
    pub(crate) fn tool_length(&mut self, machine: &Machine) -> f64 {
        if self.one_in(4) { 0.0 } else { scale(machine) * self.magnitude(0.01, 1.2) }
    }

    /// A tool pose in the table frame whose platform position at one of its table angles is a
    /// point around the machine, so that many are reachable.
    pub(crate) fn part_pose(&mut self, machine: &Machine, tool_length: f64) -> PartPose {
        let [x, y, z] = self.point(machine);
        let alpha = self.between(-PI, PI) * self.pick(&[0.1, 1.0]);
        let pose = verne_solver::PlatformPose { x, y, z, alpha };
        let [theta1, theta2] = [self.between(-1.5, 1.5), self.between(-PI, PI)];
        verne_solver::part_pose(machine, &pose, verne_solver::TableAngles { theta1, theta2 }, tool_length)
    }
}

/// The largest dimension that the equations hold, the measure of everything.
pub(crate) fn scale(machine: &Machine) -> f64 {
    let g = &machine.data().geometry;
    [g.L1, g.L2, g.L3, g.R1, g.r1, g.R2, g.r4, (g.D1 - g.d1).abs(), (g.D2 - g.d2).abs()]
        .into_iter()
        .fold(0.0, f64::max)
}
