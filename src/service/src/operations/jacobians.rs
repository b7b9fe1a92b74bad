//! The Jacobians of solutions: of one answer, and of the rows of a batch.

use std::f64::consts::PI;

use verne_solver::jacobian::{Singularity, ToolJacobian, conditioning};
use verne_solver::{Machine, Posture, TableAngles};

use crate::wire::fixed_array::FixedArray;
use crate::wire::jacobian::{
    COLUMNS, ErrorAmplification, JacobianColumns, JacobianLists, JacobianObject, MatrixObject, ROWS,
};

/// 1 µm in mm.
const MICROMETRE: f64 = 1e-3;
/// 1 arcsecond in radians.
const ARCSECOND: f64 = PI / (180.0 * 3600.0);

/// The Jacobian of a solution. `characteristic_length` is that of the request.
pub(crate) fn jacobian_object(
    machine: &Machine,
    (posture, table): (&Posture, TableAngles),
    tool_length: f64,
    length: f64,
) -> JacobianObject {
    let found = ToolJacobian::of(machine, posture, table, tool_length);
    let singularities =
        found.as_ref().map_or_else(|| vec![Singularity::Parallel], ToolJacobian::singularities);
    let drives = machine.data().drives;
    JacobianObject {
        matrix: found.as_ref().map(matrix_object),
        rows: &ROWS,
        columns: &COLUMNS,
        characteristic_length: length,
        singular_values: found.as_ref().map(|found| FixedArray(found.singular_values(length))),
        condition_number: found.as_ref().and_then(|found| found.condition_number(length)),
        singularities: singularities.into_iter().map(Into::into).collect(),
        det_p: conditioning(machine, posture).det,
        greatest_speeds: drives
            .map(|drives| found.as_ref().and_then(|found| found.greatest_speeds(&drives)).map(Into::into)),
        error_amplification: found.as_ref().map(error_amplification),
    }
}

/// The length of the request, or R1, mm.
pub(crate) fn characteristic_length(machine: &Machine, requested: Option<f64>) -> f64 {
    requested.unwrap_or(machine.data().geometry.R1)
}

fn matrix_object(found: &ToolJacobian) -> MatrixObject {
    FixedArray(found.matrix().map(|row| FixedArray(row.map(|rate| rate + 0.0))))
}

fn error_amplification(found: &ToolJacobian) -> ErrorAmplification {
    let errors = found.tip_errors(MICROMETRE, ARCSECOND);
    let [rho1, rho2, rho3, theta1, theta2] = errors.map(|error| error / MICROMETRE);
    ErrorAmplification { rho1, rho2, rho3, theta1, theta2 }
}

/// What a batch states of the Jacobian of each row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RowJacobians {
    pub(crate) columns: JacobianColumns,
    characteristic_length: f64,
    pub(crate) has_drives: bool,
}

/// The Jacobian of a row.
#[derive(Debug)]
pub(crate) struct RowJacobian {
    pub(crate) det_p: f64,
    pub(crate) condition_number: Option<f64>,
    pub(crate) greatest_speeds: Option<[f64; 3]>,
    pub(crate) matrix: Option<MatrixObject>,
}

impl RowJacobians {
    /// `None` if the request does not ask for Jacobians.
    pub(crate) fn requested(
        machine: &Machine,
        columns: Option<JacobianColumns>,
        characteristic_length: Option<f64>,
    ) -> Option<Self> {
        let characteristic_length = self::characteristic_length(machine, characteristic_length);
        let has_drives = machine.data().drives.is_some();
        columns.map(|columns| Self { columns, characteristic_length, has_drives })
    }

    /// The Jacobian of a row with a solution.
    pub(crate) fn of(
        &self,
        machine: &Machine,
        posture: &Posture,
        table: TableAngles,
        tool_length: f64,
    ) -> Box<RowJacobian> {
        let found = ToolJacobian::of(machine, posture, table, tool_length);
        let speeds = || found.as_ref()?.greatest_speeds(machine.data().drives.as_ref()?);
        Box::new(RowJacobian {
            det_p: conditioning(machine, posture).det,
            condition_number: found
                .as_ref()
                .and_then(|found| found.condition_number(self.characteristic_length)),
            greatest_speeds: speeds().map(|speeds| speeds.map(|found| found.speed)),
            matrix: found.as_ref().filter(|_| self.columns == JacobianColumns::Matrix).map(matrix_object),
        })
    }

    /// The Jacobians of all rows.
    pub(crate) fn lists<'a>(
        &self,
        rows: &(impl Iterator<Item = Option<&'a RowJacobian>> + Clone),
    ) -> JacobianLists {
        let has_matrix = self.columns == JacobianColumns::Matrix;
        let speeds =
            || rows.clone().map(|row| row.and_then(|row| row.greatest_speeds).map(FixedArray)).collect();
        JacobianLists {
            characteristic_length: self.characteristic_length,
            det_p: rows.clone().map(|row| row.map(|row| row.det_p)).collect(),
            condition_number: rows.clone().map(|row| row.and_then(|row| row.condition_number)).collect(),
            greatest_speeds: self.has_drives.then(speeds),
            matrix: has_matrix.then(|| rows.clone().map(|row| row.and_then(|row| row.matrix)).collect()),
        }
    }
}
