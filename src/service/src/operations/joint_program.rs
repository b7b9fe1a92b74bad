//! The joint program of a stored tool path.

use verne_program::joint_program::{
    JointProgramError, JointProgramOptions, JointProgramWriter, JointRow, RapidWord,
};
use verne_program::{Event, Program};
use verne_solver::toolpath::RowKind;

use crate::operations::toolpath_question::ToolpathQuestion;
use crate::operations::toolpath_row_text::{RowText, StoredRows};
use crate::operations::toolpath_rows::read_chunk;
use crate::operations::toolpath_rows::row_bytes::StoredRow;
use crate::wire::error::{FieldError, OperationError};
use crate::wire::toolpath::Tolerance;

/// Writes rows and the events of their program as a joint program.
pub(crate) struct JointProgramText(JointProgramWriter<Vec<u8>>);

impl JointProgramText {
    /// A writer for the tool path that answers a question, with the events of its program.
    ///
    /// # Errors
    ///
    /// [`OperationError::Fields`]: an option cannot be met, the words would be coarser than the tolerances, or rapids
    /// have no durations.
    pub(crate) fn new(
        mut options: JointProgramOptions,
        question: &ToolpathQuestion,
        program: &Program,
    ) -> Result<Self, OperationError> {
        check_decimals(&options, question.request.tolerance)?;
        check_rapids(&options, question.request.drives.is_some())?;
        let machine = &question.machine.id;
        options.comments = vec![
            format!("verne {}, tool path {}", env!("CARGO_PKG_VERSION"), question.id),
            format!("machine {}, hash {}", machine.name, machine.hash),
            format!("program {}", question.request.program),
        ];
        let events: Vec<Event> = program.events().to_vec();
        JointProgramWriter::new(Vec::new(), options, events).map(Self).map_err(operation_error)
    }
}

impl RowText for JointProgramText {
    fn rows(&mut self, rows: &mut StoredRows<'_>) -> Result<Vec<u8>, OperationError> {
        for row in rows {
            self.0.row(&joint_row(&row?)).map_err(operation_error)?;
        }
        Ok(std::mem::take(self.0.out()))
    }

    fn tail(self: Box<Self>) -> Result<Vec<u8>, OperationError> {
        self.0.finish().map(|(text, _)| text).map_err(operation_error)
    }
}

/// Whether the words are as fine as the tolerances that the tool path keeps.
fn check_decimals(options: &JointProgramOptions, tolerance: Tolerance) -> Result<(), OperationError> {
    let half = |decimals: u8| 0.5 / 10_f64.powi(decimals.into());
    let checked = [
        ("length_decimals", options.length_decimals, tolerance.tip, "mm"),
        ("angle_decimals", options.angle_decimals, tolerance.axis, "degrees"),
    ];
    let too_coarse = checked.into_iter().filter(|(_, decimals, tolerance, _)| half(*decimals) > *tolerance);
    let faults: Vec<_> = too_coarse
        .map(|(parameter, decimals, tolerance, unit)| {
            let least = (decimals..u8::MAX).find(|decimals| half(*decimals) <= tolerance).unwrap_or(u8::MAX);
            let detail = format!(
                "words would differ from the joints by {} {unit}, but the tool path keeps {tolerance} {unit}; state \
                 at least {least} decimals",
                half(decimals)
            );
            FieldError::new(format!("/query/{parameter}"), detail)
        })
        .collect();
    if faults.is_empty() { Ok(()) } else { Err(OperationError::Fields(faults)) }
}

/// Whether rapids have the durations that their word needs.
fn check_rapids(options: &JointProgramOptions, has_drives: bool) -> Result<(), OperationError> {
    if options.rapids == RapidWord::G0 || has_drives {
        return Ok(());
    }
    let detail = "g1 needs the duration of rapids, which the drives of the machine determine; plan the tool path with \
                  drives in the machine, or use g0";
    Err(OperationError::Fields(vec![FieldError::new("/query/rapid_word", detail)]))
}

/// Whether a joint program can state the speed of every row of a chunk.
///
/// # Errors
///
/// [`OperationError::NoJointProgram`], with the line of a row without a duration.
pub(crate) fn check_durations(chunk: &[u8]) -> Result<(), OperationError> {
    for row in read_chunk(chunk) {
        let row = row?;
        if row.kind.is_cut() && row.duration.is_none() {
            return Err(operation_error(JointProgramError::NoDuration { line: row.line }));
        }
    }
    Ok(())
}

fn joint_row(row: &StoredRow) -> JointRow {
    let ([rho1, rho2, rho3], table) = (row.rho, row.table);
    // A retract begins at the part, and an approach ends there: in G0 a controller may not move the joints linearly.
    let rapid = match row.kind {
        RowKind::Rapid => true,
        RowKind::Retract | RowKind::Rewind | RowKind::Approach => row.duration.is_none(),
        RowKind::Feed | RowKind::Inserted | RowKind::Turn => false,
    };
    JointRow {
        step: row.index as usize,
        line: row.line,
        rapid,
        joints: [rho1, rho2, rho3, table.theta1, table.theta2],
        tip: row.position.tip,
        duration: row.duration,
    }
}

fn operation_error(error: JointProgramError) -> OperationError {
    match error {
        JointProgramError::NoDuration { .. } => OperationError::NoJointProgram(error.to_string()),
        JointProgramError::OutOfRange { .. } => {
            OperationError::Fields(vec![FieldError::new("/query/length_decimals", error.to_string())])
        }
        JointProgramError::Options(error) => {
            OperationError::Fields(vec![FieldError::new(format!("/query/{}", error.option), error.detail)])
        }
        JointProgramError::Write(_) => OperationError::Internal,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use verne_program::joint_program::{JointProgramOptions, JointProgramWriter};
    use verne_solver::toolpath::{RowKind, ToolPosition};
    use verne_solver::{Constraint, Element, Margin, TableAngles};

    use super::{JointProgramText, check_decimals, check_durations};
    use crate::operations::toolpath_row_text::RowText;
    use crate::operations::toolpath_rows::row_bytes::{StoredRow, write_row};
    use crate::wire::error::{FieldError, OperationError};
    use crate::wire::toolpath::Tolerance;

    fn row(index: u32, kind: RowKind, duration: Option<f64>) -> StoredRow {
        let rho = [600.0 + f64::from(index), 600.0, 600.0];
        StoredRow {
            line: index + 3,
            index,
            kind,
            position: ToolPosition { tip: [f64::from(index), 0.0, 0.0], axis: [0.0, 0.0, 1.0] },
            rho,
            table: TableAngles { theta1: 0.0, theta2: 0.5_f64.to_radians() },
            duration,
            margin: Margin {
                constraint: Constraint::Tilt,
                element: Element::Range { high: true },
                value: 1.0,
            },
        }
    }

    #[test]
    fn rows_become_blocks_in_degrees_with_the_time_that_they_take() {
        let writer = JointProgramWriter::new(Vec::new(), JointProgramOptions::default(), Vec::new());
        let mut text = JointProgramText(writer.unwrap());
        let rows = [
            row(0, RowKind::Rapid, None),
            row(1, RowKind::Feed, Some(0.5)),
            row(2, RowKind::Turn, Some(1.0)),
        ];
        let first = text.rows(&mut rows[..2].iter().map(|row| Ok(*row))).unwrap();
        let second = text.rows(&mut rows[2..].iter().map(|row| Ok(*row))).unwrap();
        let tail = Box::new(text).tail().unwrap();
        let all = String::from_utf8([first, second, tail].concat()).unwrap();
        assert!(
            all.ends_with("G0 X600.0 Y600.0 Z600.0 A0.0 C0.5\nG1 X601.0 F120.0\nX602.0 F60.0\nM30\n"),
            "{all}"
        );
    }

    #[test]
    fn a_retract_with_a_duration_is_linear() {
        let writer = JointProgramWriter::new(Vec::new(), JointProgramOptions::default(), Vec::new());
        let mut text = JointProgramText(writer.unwrap());
        let rows = [
            row(0, RowKind::Rapid, Some(1.0)),
            row(1, RowKind::Retract, Some(1.0)),
            row(2, RowKind::Rewind, Some(0.5)),
            row(3, RowKind::Approach, None),
        ];
        let all = String::from_utf8(text.rows(&mut rows.iter().map(|row| Ok(*row))).unwrap()).unwrap();
        assert!(
            all.ends_with("G0 X600.0 Y600.0 Z600.0 A0.0 C0.5\nG1 X601.0 F60.0\nX602.0 F120.0\nG0 X603.0\n"),
            "{all}"
        );
    }

    #[test]
    fn a_row_without_duration_is_refused_with_its_line() {
        let mut chunk = Vec::new();
        write_row(&row(0, RowKind::Rapid, None), &mut chunk);
        assert_eq!(check_durations(&chunk), Ok(()));
        write_row(&row(1, RowKind::Inserted, None), &mut chunk);
        let Err(OperationError::NoJointProgram(reason)) = check_durations(&chunk) else {
            unreachable!("the row has no duration")
        };
        assert!(reason.contains("line 4"), "{reason}");
    }

    #[test]
    fn words_are_not_coarser_than_the_tolerances() {
        let tolerance = Tolerance { tip: 0.005, axis: 0.01, rapid: 1.0 };
        let checked = |length_decimals, angle_decimals| {
            let options =
                JointProgramOptions { length_decimals, angle_decimals, ..JointProgramOptions::default() };
            check_decimals(&options, tolerance)
        };
        assert_eq!(checked(2, 2), Ok(()));
        let coarse = |parameter: &str, detail: &str| FieldError::new(format!("/query/{parameter}"), detail);
        let length = coarse(
            "length_decimals",
            "words would differ from the joints by 0.05 mm, but the tool path keeps 0.005 mm; state at least \
             2 decimals",
        );
        let angle = coarse(
            "angle_decimals",
            "words would differ from the joints by 0.5 degrees, but the tool path keeps 0.01 degrees; state at \
             least 2 decimals",
        );
        assert_eq!(checked(1, 5), Err(OperationError::Fields(vec![length.clone()])));
        assert_eq!(checked(1, 0), Err(OperationError::Fields(vec![length, angle])));
    }
}
