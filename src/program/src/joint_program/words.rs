//! The five axis words of a row.

use super::JointRow;
use super::error::JointProgramError;
use super::numbers::Fixed;
use super::options::{JointAxis, JointProgramOptions};

/// The names of the joints, in the order of the axes.
const JOINTS: [&str; 5] = ["rho1", "rho2", "rho3", "theta1", "theta2"];

/// The words of a row.
pub(super) fn words(options: &JointProgramOptions, row: &JointRow) -> Result<[Fixed; 5], JointProgramError> {
    let mut words = [Fixed::ZERO; 5];
    for (index, (axis, joint)) in options.axes.iter().zip(row.joints).enumerate() {
        let value = if axis.negative { axis.offset - joint } else { axis.offset + joint };
        let word = if index < 3 {
            Fixed::nearest(value, options.length_decimals)
        } else {
            Fixed::nearest(value.to_degrees(), options.angle_decimals)
        };
        let refused = JointProgramError::OutOfRange { line: row.line, letter: axis.letter };
        words[index] = word.ok_or(refused)?;
    }
    Ok(words)
}

/// The meaning of the words: one line for the head of the program.
pub(super) fn legend(options: &JointProgramOptions) -> String {
    let word = |index: usize, axis: &JointAxis| {
        let mut text = format!("{} = ", axis.letter);
        if axis.offset != 0.0 {
            let (offset, decimals) = if index < 3 {
                (axis.offset, options.length_decimals)
            } else {
                (axis.offset.to_degrees(), options.angle_decimals)
            };
            if let Some(number) = Fixed::nearest(offset, decimals) {
                number.append_to(&mut text);
            }
            text.push_str(if axis.negative { " - " } else { " + " });
        } else if axis.negative {
            text.push('-');
        }
        text + JOINTS[index]
    };
    let words: Vec<_> = options.axes.iter().enumerate().map(|(index, axis)| word(index, axis)).collect();
    words.join(", ")
}
