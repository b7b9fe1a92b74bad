//! Options that are met, and options that are refused.

use verne_program::joint_program::{JointAxis, JointProgramError, JointProgramOptions};

use crate::{body, row, write};

fn refused(change: impl FnOnce(&mut JointProgramOptions)) -> &'static str {
    let mut options = JointProgramOptions::default();
    change(&mut options);
    match write(&options, &[], &[]) {
        Err(JointProgramError::Options(error)) => error.option,
        other => panic!("{other:?}"),
    }
}

#[test]
fn options_that_cannot_be_met_are_refused() {
    assert_eq!(refused(|o| o.axes[0] = JointAxis::new('Y')), "axes");
    assert_eq!(refused(|o| o.axes[0] = JointAxis::new('x')), "axes");
    assert_eq!(refused(|o| o.axes[0] = JointAxis::new('F')), "axes");
    assert_eq!(refused(|o| o.axes[0].offset = f64::NAN), "axes");
    assert_eq!(refused(|o| o.length_decimals = 9), "length_decimals");
    assert_eq!(refused(|o| o.angle_decimals = 9), "angle_decimals");
    assert_eq!(refused(|o| o.greatest_feed = 0.0), "greatest_feed");
    assert_eq!(refused(|o| o.numbers = Some(0)), "numbers");
    assert_eq!(refused(|o| o.head = vec!["G0\nX0".to_owned()]), "head");
    assert_eq!(refused(|o| o.foot = vec!["M30".to_owned(); 101]), "foot");
}

#[test]
fn the_head_says_what_the_words_mean() {
    let mut options = JointProgramOptions {
        head: vec!["%".to_owned(), "O100".to_owned()],
        comments: vec!["machine 0123abcd".to_owned()],
        foot: vec!["M2".to_owned(), "%".to_owned()],
        ..JointProgramOptions::default()
    };
    options.axes[2] = JointAxis { letter: 'Z', negative: true, offset: 1600.5 };
    options.axes[3].negative = true;
    let (text, _) = write(&options, &[], &[]).unwrap();
    let expected = [
        "%",
        "O100",
        "(machine 0123abcd)",
        "(X = rho1, Y = rho2, Z = 1600.5 - rho3, A = -theta1, C = theta2)",
        "(words differ from joints by at most 0.00005 mm and 0.000005 degrees)",
        "(F is at most 99999.0; if a block needs more, a comment at the end says so)",
        "G21 G90 G40 G49 G80 G93",
        "M2",
        "%",
    ];
    assert_eq!(text.lines().collect::<Vec<_>>(), expected);
}

#[test]
fn blocks_have_numbers_and_source_lines_if_asked() {
    let options =
        JointProgramOptions { numbers: Some(40_000), source_lines: true, ..JointProgramOptions::default() };
    let at = |step, x| row(step, [x, 0.0, 0.0, 0.0, 0.0], Some(1.0));
    let (text, _) = write(&options, &[], &[at(0, 1.0), at(1, 2.0), at(1, 3.0)]).unwrap();
    let expected =
        ["N80000 G0 X1.0 Y0.0 Z0.0 A0.0 C0.0 (line 2)", "N40000 G1 X2.0 F60.0 (line 3)", "N80000 X3.0 F60.0"];
    assert_eq!(body(&text), expected);
}
