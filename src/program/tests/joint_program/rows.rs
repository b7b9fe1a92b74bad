//! Rows that are read back are the rows that were written.

use verne_program::joint_program::{
    FeedWord, JointAxis, JointProgramError, JointProgramOptions, JointRow, RapidWord,
};

use crate::reader::positions;
use crate::{body, row, write};

/// Rows of a winding path; the numbers are irregular and the same in every run.
fn rows() -> Vec<JointRow> {
    let mut rows = vec![row(0, [600.0, 550.5, 580.25, 0.1, -3.0], None)];
    for step in 1..500_u32 {
        let s = f64::from(step);
        let joints =
            [600.0 + 9.7 * (0.11 * s).sin(), 550.5, 580.25 - 0.37 * s, 0.1 * s.cos(), 0.07 * s - 3.0];
        rows.push(row(step as usize, joints, Some(0.01 + 0.3 * (0.7 * s).sin().abs())));
    }
    rows
}

fn mirrored() -> JointProgramOptions {
    let mut axes = ['U', 'V', 'W', 'B', 'C'].map(JointAxis::new);
    axes[1] = JointAxis { letter: 'V', negative: true, offset: 1000.0 };
    axes[4] = JointAxis { letter: 'C', negative: true, offset: 0.25 };
    JointProgramOptions { axes, ..JointProgramOptions::default() }
}

#[test]
fn joints_are_read_back_within_the_rounding_that_is_stated() {
    for options in [JointProgramOptions::default(), mirrored()] {
        for decimals in [0, 3, 8] {
            let options = JointProgramOptions {
                length_decimals: decimals,
                angle_decimals: decimals,
                ..options.clone()
            };
            let letters: String = options.axes.iter().map(|axis| axis.letter).collect();
            let [length, angle] = options.rounding();
            let (text, summary) = write(&options, &[], &rows()).unwrap();
            let read = positions(&text, &letters);
            assert_eq!((summary.blocks, summary.merged), (read.len() as u64, 500 - read.len() as u64));
            let mut rows = rows().into_iter();
            for position in read {
                let near = |row: &JointRow| {
                    options.axes.iter().zip(row.joints).enumerate().all(|(index, (axis, joint))| {
                        let sign = if axis.negative { -1.0 } else { 1.0 };
                        let (word, bound) = if index < 3 {
                            (position.words[&axis.letter], length)
                        } else {
                            (position.words[&axis.letter].to_radians(), angle)
                        };
                        (sign * (word - axis.offset) - joint).abs() <= bound * (1.0 + 1e-6)
                    })
                };
                assert!(rows.any(|row| near(&row)), "{position:?}");
            }
        }
    }
}

#[test]
fn inverse_time_gives_every_block_its_duration() {
    let (text, summary) = write(&JointProgramOptions::default(), &[], &rows()).unwrap();
    let read = positions(&text, "XYZAC");
    assert_eq!((read.len(), summary.limited), (500, 0));
    assert!(read[0].rapid && !read[0].has_feed);
    for (row, position) in rows().iter().zip(read).skip(1) {
        assert!(position.has_feed && !position.rapid);
        let duration = 60.0 / position.feed.unwrap();
        assert!((duration / row.duration.unwrap() - 1.0).abs() < 1e-5, "{duration}");
    }
}

#[test]
fn per_minute_is_the_speed_of_the_tip_and_where_it_stands_that_of_the_table() {
    let options = JointProgramOptions { feed: FeedWord::PerMinute, ..JointProgramOptions::default() };
    let first = row(0, [600.0, 600.0, 600.0, 0.0, 0.0], None);
    let moved = row(1, [605.0, 600.0, 600.0, 0.0, 0.0], Some(0.5));
    let again = row(2, [610.0, 600.0, 600.0, 0.0, 0.0], Some(0.5));
    let turned = row(3, [610.0, 600.0, 600.0, 0.0, 90_f64.to_radians()], Some(2.0));
    let (text, _) = write(&options, &[], &[first, moved, again, turned]).unwrap();
    assert!(text.contains(" G94\n"));
    assert_eq!(
        body(&text),
        ["G0 X600.0 Y600.0 Z600.0 A0.0 C0.0", "G1 X605.0 F600.0", "X610.0", "C90.0 F2700.0"]
    );
}

#[test]
fn a_row_without_duration_or_motion_divides_by_nothing() {
    let joints = [600.0, 600.0, 600.0, 0.0, 0.0];
    let mut next = joints;
    next[0] += 0.01;
    let rows = [
        row(0, joints, None),
        row(1, joints, Some(0.0)),
        row(1, joints, Some(2.0)),
        row(2, next, Some(1.0)),
        row(3, joints, Some(0.0)),
    ];
    for (feed, f) in [(FeedWord::InverseTime, "F20.0"), (FeedWord::PerMinute, "F0.2")] {
        let options = JointProgramOptions { feed, greatest_feed: 5000.0, ..JointProgramOptions::default() };
        let (text, summary) = write(&options, &[], &rows).unwrap();
        let body = body(&text);
        assert_eq!(body[1], format!("G1 X600.01 {f}"));
        assert_eq!(body[2], "X600.0 F5000.0");
        assert_eq!((summary.blocks, summary.merged, summary.limited), (3, 2, 1));
    }
}

#[test]
fn the_program_says_that_the_greatest_f_limits_blocks() {
    let at = |step, x| row(step, [x, 0.0, 0.0, 0.0, 0.0], Some(0.5));
    let rows = [at(0, 1.0), at(1, 2.0), at(2, 3.0)];
    let limited = |greatest_feed| {
        let options = JointProgramOptions { greatest_feed, ..JointProgramOptions::default() };
        let (text, summary) = write(&options, &[], &rows).unwrap();
        let line = text.lines().rev().nth(1).unwrap_or_default().to_owned();
        (summary.limited, line)
    };
    let comment = "(blocks that need more than F60.0 and take longer than planned: 2, the first of line 3)";
    assert_eq!(limited(60.0), (2, comment.to_owned()));
    assert_eq!(limited(120.0), (0, "X3.0 F120.0".to_owned()));
}

#[test]
fn a_feed_without_duration_is_refused_with_its_line() {
    let rows = [row(0, [600.0; 5], None), row(1, [601.0; 5], None)];
    let outcome = write(&JointProgramOptions::default(), &[], &rows);
    assert!(matches!(outcome, Err(JointProgramError::NoDuration { line: 3 })));
}

#[test]
fn rapids_are_g0_or_g1_as_asked() {
    let mut second = row(1, [601.0, 0.0, 0.0, 0.0, 0.0], Some(0.5));
    second.rapid = true;
    let rows = [row(0, [600.0, 0.0, 0.0, 0.0, 0.0], None), second];
    let (text, _) = write(&JointProgramOptions::default(), &[], &rows).unwrap();
    assert_eq!(body(&text)[1], "X601.0");
    let options = JointProgramOptions { rapids: RapidWord::G1, ..JointProgramOptions::default() };
    let (text, _) = write(&options, &[], &rows).unwrap();
    assert_eq!(body(&text), ["G0 X600.0 Y0.0 Z0.0 A0.0 C0.0", "G1 X601.0 F120.0"]);
}

#[test]
fn negative_zeros_do_not_occur() {
    let rows =
        [row(0, [-0.0, -1e-17, -0.000_049, -0.0, -1e-9], None), row(1, [0.0, 0.0, 0.0, 1.0, 0.0], Some(1.0))];
    let (text, _) = write(&JointProgramOptions::default(), &[], &rows).unwrap();
    assert_eq!(body(&text)[0], "G0 X0.0 Y0.0 Z0.0 A0.0 C0.0");
    let axes = mirrored().axes.map(|axis| JointAxis { negative: true, offset: 0.0, ..axis });
    let (text, _) = write(&JointProgramOptions { axes, ..mirrored() }, &[], &rows).unwrap();
    assert_eq!(body(&text)[0], "G0 U0.0 V0.0 W0.0 B0.0 C0.0");
}
