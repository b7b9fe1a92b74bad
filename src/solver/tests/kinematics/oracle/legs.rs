//! The machine as rods between points in space, from its plain data.

use nalgebra::{Matrix4, SVector, Vector3, Vector4};
use verne_solver::Machine;
use verne_solver::machine::Geometry;

/// The four rods whose lengths are Eqs (3)-(6).
const RODS: [u8; 4] = [11, 12, 21, 31];

/// The rods of a machine.
#[derive(Clone, Copy)]
pub(crate) struct Legs {
    pub(crate) g: Geometry,
}

impl Legs {
    /// The rods of a machine.
    pub(crate) fn of(machine: &Machine) -> Self {
        Self { g: machine.data().geometry }
    }

    /// The largest length, the measure of everything.
    pub(crate) fn scale(&self) -> f64 {
        let g = &self.g;
        [g.L1, g.L2, g.L3, g.R1, g.r1, g.R2, g.r4, (g.D1 - g.d1).abs(), (g.D2 - g.d2).abs()]
            .into_iter()
            .fold(0.0, f64::max)
    }

    /// A rod's joint on its slider in the base frame, the slider at z = 0.
    pub(crate) fn on_slider(&self, rod: u8) -> Vector3<f64> {
        let g = &self.g;
        let middle = match rod / 10 {
            1 => Vector3::new(g.d1, 0.0, 0.0),
            2 => Vector3::new(g.d2, -g.r4, 0.0),
            _ => Vector3::new(g.d2, g.r4, 0.0),
        };
        middle + self.beside(rod, g.r1)
    }

    /// A rod's joint on the platform in the platform frame.
    pub(crate) fn on_platform(&self, rod: u8) -> Vector3<f64> {
        let g = &self.g;
        let middle = match rod / 10 {
            1 => Vector3::new(g.D1, 0.0, 0.0),
            2 => Vector3::new(g.D2, -g.R2, 0.0),
            _ => Vector3::new(g.D2, g.R2, 0.0),
        };
        middle + self.beside(rod, g.R1)
    }

    /// A rod's joint from the middle of its leg's two: along y for leg I, along its own direction for a parallelogram.
    fn beside(&self, rod: u8, half_width_of_leg_one: f64) -> Vector3<f64> {
        let (g, w) = (self.g.parallelogram_direction, self.g.parallelogram_half_width);
        let towards_first = match rod / 10 {
            1 => Vector3::new(0.0, half_width_of_leg_one, 0.0),
            2 => Vector3::new(w * g.cos(), w * g.sin(), 0.0),
            _ => Vector3::new(w * g.cos(), -w * g.sin(), 0.0),
        };
        if rod % 10 == 1 { towards_first } else { -towards_first }
    }

    /// A rod's nominal length.
    pub(crate) fn length(&self, rod: u8) -> f64 {
        [self.g.L1, self.g.L2, self.g.L3][slider(rod)]
    }

    /// A rod from its slider to the platform at `q` = (x, y, z, alpha).
    pub(crate) fn rod(&self, rod: u8, q: &Vector4<f64>, rho: &[f64; 3]) -> Vector3<f64> {
        let b = self.on_platform(rod);
        let (s, c) = q[3].sin_cos();
        let a = self.on_slider(rod);
        // The slider is subtracted from the platform first: both may be far from the origin.
        Vector3::new(q[0] + (b.x - a.x), q[1] + (b.y * c - a.y), (q[2] - rho[slider(rod)]) + b.y * s)
    }

    /// How much each of the four rods is too long.
    pub(crate) fn errors(&self, q: &Vector4<f64>, rho: &[f64; 3]) -> Vector4<f64> {
        Vector4::from_fn(|i, _| {
            let (d, length) = (self.rod(RODS[i], q, rho), self.length(RODS[i]));
            // The difference of squares over the sum, without the cancellation of a difference of roots.
            (d.norm_squared() - length * length) / (d.norm() + length)
        })
    }

    /// The largest error of a rod's length.
    pub(crate) fn residual(&self, q: &Vector4<f64>, rho: &[f64; 3]) -> f64 {
        self.errors(q, rho).amax()
    }

    /// Rates of the four rods' lengths with x, y, z and R1 alpha.
    pub(crate) fn rates(&self, q: &Vector4<f64>, rho: &[f64; 3]) -> Matrix4<f64> {
        let (s, c) = q[3].sin_cos();
        let mut rates = Matrix4::zeros();
        for (i, &rod) in RODS.iter().enumerate() {
            let d = self.rod(rod, q, rho).normalize();
            let b = self.on_platform(rod);
            let turning = d.y * (-b.y * s) + d.z * (b.y * c);
            rates.set_row(i, &nalgebra::RowVector4::new(d.x, d.y, d.z, turning / self.g.R1));
        }
        rates
    }

    /// Rates of the four rods' lengths with the three sliders: one value a row, in the column of
    /// the rod's slider.
    pub(crate) fn slider_rates(&self, q: &Vector4<f64>, rho: &[f64; 3]) -> [SVector<f64, 3>; 4] {
        RODS.map(|rod| {
            let mut row = SVector::<f64, 3>::zeros();
            row[slider(rod)] = -self.rod(rod, q, rho).normalize().z;
            row
        })
    }
}

/// Index of the slider that a rod hangs on.
fn slider(rod: u8) -> usize {
    usize::from(rod / 10) - 1
}
