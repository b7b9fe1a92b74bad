//! Differential kinematics: parallel and serial singularities (types 2 and 1).
//!
//! Each of Eqs (3)-(6) is a rod's squared length, so its derivative is twice `b · d(B - A)` with b = B - A. The row
//! of rod 11 is (bx, by, bz, -R1 sin a · by + R1 cos a · bz) against (x, y, z, a) and -bz against its slider. The
//! other rods differ in the sign and length of the arm.

mod tool_jacobian;

use nalgebra::{Matrix4, Matrix4x3};

pub use crate::parallel_matrix::ParallelMatrix;
pub use tool_jacobian::{GreatestSpeed, Singularity, ToolJacobian};

use crate::machine::Machine;
use crate::parallel_matrix::{determinant, matrix};
use crate::posture::Posture;
use crate::rods::Rods;

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
/// use verne_solver::{KinematicsError, Machine, platform_working};
///
/// let machine = Machine::verne();
/// let posture = platform_working(&machine, [0.0, 0.0, 1200.0])?;
/// let rows = parallel_matrix(&machine, &posture);
/// let [x, y, z, _] = rows[0];
/// assert!((x * x + y * y + z * z - 1.0).abs() < 1e-12, "a rod's direction");
/// # Ok::<(), KinematicsError>(())
/// ```
pub fn parallel_matrix(machine: &Machine, posture: &Posture) -> ParallelMatrix {
    matrix(machine.geometry(), &Rods::of(&machine.mechanism, &posture.pose, posture.rho))
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
/// use verne_solver::{KinematicsError, Machine, platform_working};
///
/// let machine = Machine::verne();
/// let state = conditioning(&machine, &platform_working(&machine, [0.0, 0.0, 1200.0])?);
/// assert!(state.det.abs() > 0.05 && state.serial.iter().all(|cosine| *cosine > 0.1));
/// # Ok::<(), KinematicsError>(())
/// ```
pub fn conditioning(machine: &Machine, posture: &Posture) -> Conditioning {
    let rods = Rods::of(&machine.mechanism, &posture.pose, posture.rho);
    let rows = matrix(machine.geometry(), &rods);
    Conditioning {
        det: determinant(&rows),
        condition_number: condition_number(&Matrix4::from_fn(|row, column| rows[row][column])),
        serial: rods.directions.map(|direction| direction[2]),
    }
}

/// Ratio of the greatest to the least singular value; `None` for a singular matrix.
fn condition_number(matrix: &Matrix4<f64>) -> Option<f64> {
    let values = matrix.singular_values();
    let (most, least) = (values.max(), values.min());
    (least > SINGULAR * most).then(|| most / least)
}

/// Whether a parallel matrix is singular to double precision.
pub(crate) fn is_singular(rows: &ParallelMatrix) -> bool {
    condition_number(&Matrix4::from_fn(|row, column| rows[row][column])).is_none()
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
/// use verne_solver::{KinematicsError, Machine, platform_working};
///
/// let machine = Machine::verne();
/// let posture = platform_working(&machine, [30.0, -80.0, 1200.0])?;
/// let rates = velocities(&machine, &posture).expect("not singular");
/// let [_, _, z, alpha] = rates.map(|row| row.iter().sum::<f64>());
/// assert!((z - 1.0).abs() < 1e-9 && alpha.abs() < 1e-9, "sliders that move together carry the platform along");
/// # Ok::<(), KinematicsError>(())
/// ```
pub fn velocities(machine: &Machine, posture: &Posture) -> Option<[[f64; 3]; 4]> {
    let rods = Rods::of(&machine.mechanism, &posture.pose, posture.rho);
    let rows = matrix(machine.geometry(), &rods);
    let [d1, d2, d3, d4] = rods.directions.map(|direction| direction[2]);
    let sliders = Matrix4x3::new(d1, 0.0, 0.0, d2, 0.0, 0.0, 0.0, d3, 0.0, 0.0, 0.0, d4);
    let matrix = Matrix4::from_fn(|row, column| rows[row][column]);
    condition_number(&matrix)?;
    let rates = matrix.lu().solve(&sliders)?;
    let units = [1.0, 1.0, 1.0, 1.0 / machine.geometry().R1];
    Some(std::array::from_fn(|row| std::array::from_fn(|column| rates[(row, column)] * units[row])))
}
