//! Differential kinematics: parallel and serial singularities (types 2 and 1).
//!
//! Each of Eqs (3)-(6) is a rod's squared length, so its derivative is twice `b · d(B - A)` with b = B - A. The row
//! of rod 11 is (bx, by, bz, -R1 sin a · by + R1 cos a · bz) against (x, y, z, a) and -bz against its slider. The
//! other rods differ in the sign and length of the arm.

use nalgebra::{Matrix4, Matrix4x3};

use crate::machine::{Geometry, Machine};
use crate::posture::Posture;
use crate::rods::Rods;

/// The dimensionless 4×4 matrix of rods 11, 12, leg II, leg III (rows, divided by the rod length)
/// against x, y, z, R1 alpha (columns).
pub type ParallelMatrix = [[f64; 4]; 4];

/// Below this ratio of singular values a matrix is singular to double precision.
const SINGULAR: f64 = 1e-14;

/// The distance of a posture from singularities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conditioning {
    /// Determinant of the parallel matrix, `det_P`; zero at a parallel (type 2) singularity.
    pub det: f64,
    /// Condition number of the parallel matrix in the 2-norm; `None` where it is singular.
    pub condition_number: Option<f64>,
    /// Cosine between each rod (11, 12, II, III) and its guideway; zero at a serial singularity.
    pub serial: [f64; 4],
}

/// Computes the parallel matrix of a posture: the derivative of Eqs (3)-(6) by x, y, z and R1 alpha.
///
/// # Units
///
/// None: each row is divided by its rod length, and the last column is per R1 alpha.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6).
/// Gosselin, Angeles 1990, [doi:10.1109/70.56660](https://doi.org/10.1109/70.56660): singularities of types 1 and 2.
///
/// # Examples
///
/// ```
/// use verne_solver::jacobian::parallel_matrix;
/// use verne_solver::{Machine, Refusal, platform_working};
///
/// let machine = Machine::verne();
/// let posture = platform_working(&machine, [0.0, 0.0, 1200.0])?;
/// let rows = parallel_matrix(&machine, &posture);
/// let [x, y, z, _] = rows[0];
/// assert!((x * x + y * y + z * z - 1.0).abs() < 1e-12, "a rod's direction");
/// # Ok::<(), Refusal>(())
/// ```
pub fn parallel_matrix(machine: &Machine, posture: &Posture) -> ParallelMatrix {
    matrix(machine.geometry(), &Rods::of(machine, &posture.pose, posture.rho))
}

/// Computes the determinant and the condition number of the parallel matrix, and the serial cosines.
///
/// # Units
///
/// None: all numbers are dimensionless.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): section IV.A.
/// Gosselin, Angeles 1990, [doi:10.1109/70.56660](https://doi.org/10.1109/70.56660): singularities of types 1 and 2.
///
/// # Examples
///
/// ```
/// use verne_solver::jacobian::conditioning;
/// use verne_solver::{Machine, Refusal, platform_working};
///
/// let machine = Machine::verne();
/// let state = conditioning(&machine, &platform_working(&machine, [0.0, 0.0, 1200.0])?);
/// assert!(state.det.abs() > 0.05 && state.serial.iter().all(|cosine| *cosine > 0.1));
/// # Ok::<(), Refusal>(())
/// ```
pub fn conditioning(machine: &Machine, posture: &Posture) -> Conditioning {
    let rods = Rods::of(machine, &posture.pose, posture.rho);
    let rows = matrix(machine.geometry(), &rods);
    Conditioning {
        det: determinant(&rows),
        condition_number: spread(&Matrix4::from_fn(|row, column| rows[row][column])),
        serial: rods.directions.map(|direction| direction[2]),
    }
}

/// Ratio of the greatest to the least singular value; `None` for a singular matrix.
fn spread(matrix: &Matrix4<f64>) -> Option<f64> {
    let values = matrix.singular_values();
    let (most, least) = (values.max(), values.min());
    (least > SINGULAR * most).then(|| most / least)
}

/// Computes the rates d(x, y, z, alpha)/d(rho1, rho2, rho3): row for the coordinate, column for the slider. The answer
/// is `None` at a parallel singularity.
///
/// # Units
///
/// mm/mm for x, y, z; rad/mm for alpha.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6), differentiated.
/// Gosselin, Angeles 1990, [doi:10.1109/70.56660](https://doi.org/10.1109/70.56660): singularities of types 1 and 2.
///
/// # Examples
///
/// ```
/// use verne_solver::jacobian::velocities;
/// use verne_solver::{Machine, Refusal, platform_working};
///
/// let machine = Machine::verne();
/// let posture = platform_working(&machine, [30.0, -80.0, 1200.0])?;
/// let rates = velocities(&machine, &posture).expect("not singular");
/// let [_, _, z, alpha] = rates.map(|row| row.iter().sum::<f64>());
/// assert!((z - 1.0).abs() < 1e-9 && alpha.abs() < 1e-9, "sliders that move together carry the platform along");
/// # Ok::<(), Refusal>(())
/// ```
pub fn velocities(machine: &Machine, posture: &Posture) -> Option<[[f64; 3]; 4]> {
    let rods = Rods::of(machine, &posture.pose, posture.rho);
    let rows = matrix(machine.geometry(), &rods);
    let [d1, d2, d3, d4] = rods.directions.map(|direction| direction[2]);
    let sliders = Matrix4x3::new(d1, 0.0, 0.0, d2, 0.0, 0.0, 0.0, d3, 0.0, 0.0, 0.0, d4);
    let matrix = Matrix4::from_fn(|row, column| rows[row][column]);
    spread(&matrix)?;
    let rates = matrix.lu().solve(&sliders)?;
    let units = [1.0, 1.0, 1.0, 1.0 / machine.geometry().R1];
    Some(std::array::from_fn(|row| std::array::from_fn(|column| rates[(row, column)] * units[row])))
}

/// The dimensionless parallel matrix.
#[inline]
pub(crate) fn matrix(g: &Geometry, rods: &Rods) -> ParallelMatrix {
    let ratio = g.R2 / g.R1;
    let arms = [1.0, -1.0, -ratio, ratio];
    let row = |i: usize| {
        let [x, y, z] = rods.directions[i];
        [x, y, z, arms[i] * (rods.c * z - rods.s * y)]
    };
    [row(0), row(1), row(2), row(3)]
}

/// Determinant by complementary 2×2 minors.
#[inline]
pub(crate) fn determinant(m: &ParallelMatrix) -> f64 {
    let upper = |i: usize, j: usize| m[0][i] * m[1][j] - m[0][j] * m[1][i];
    let lower = |i: usize, j: usize| m[2][i] * m[3][j] - m[2][j] * m[3][i];
    upper(0, 1) * lower(2, 3) - upper(0, 2) * lower(1, 3)
        + upper(0, 3) * lower(1, 2)
        + upper(1, 2) * lower(0, 3)
        - upper(1, 3) * lower(0, 2)
        + upper(2, 3) * lower(0, 1)
}

/// `det_P` in a pose at home: x = y = alpha = 0.
pub(crate) fn det_at_home(g: &Geometry) -> f64 {
    determinant(&matrix(g, &at_home(g).rods))
}

/// The home pose x = y = alpha = 0 with all sliders above.
pub(crate) struct Home {
    /// The rods.
    pub(crate) rods: Rods,
    /// z - rho of the three sliders, mm.
    pub(crate) drops: [f64; 3],
}

/// Home; it exists in every valid machine.
pub(crate) fn at_home(g: &Geometry) -> Home {
    let x = [g.D1 - g.d1, g.D2 - g.d2];
    let (u, p) = (g.R1 - g.r1, g.R2 - g.r4);
    let drop = |length: f64, x: f64, y: f64| (length * length - x * x - y * y).max(0.0).sqrt();
    let drops = [drop(g.L1, x[0], u), drop(g.L2, x[1], p), drop(g.L3, x[1], p)];
    let inverse = [1.0 / g.L1, 1.0 / g.L1, 1.0 / g.L2, 1.0 / g.L3];
    Home { rods: Rods::new(g, &inverse, x, 0.0, drops, [1.0, 0.0]), drops }
}
