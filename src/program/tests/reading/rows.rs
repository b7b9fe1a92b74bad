//! Programs as rows: CSV, NDJSON and points.

use std::f64::consts::{FRAC_PI_2, PI};

use verne_program::{
    Feed, FeedUnit, Format, MoveKind, Orientation, Program, ReadOptions, Row, Units, read, read_points,
};

use crate::{assert_near, faults_of, place, tips, warnings};

fn csv(text: &str) -> Program {
    read(Format::Csv, text.as_bytes(), &ReadOptions::default()).unwrap()
}

fn ndjson(text: &str) -> Program {
    read(Format::Ndjson, text.as_bytes(), &ReadOptions::default()).unwrap()
}

#[track_caller]
fn refused(format: Format, text: &str, at: (u32, u32, &str), part: &str) {
    let refused = faults_of(format, text.as_bytes());
    let error = &refused.errors[0];
    assert_eq!(place(error), at, "{error}");
    assert!(error.detail.contains(part), "{error}");
}

#[test]
fn columns_stand_in_any_order_and_blanks_and_quotes_do_not_matter() {
    let program = csv(
        "\u{FEFF}Kind, k,j,i ,\"z\",Y,x,feed,line\r\nrapid,1,0,0,3,2,1,,\r\n\n,4,-3,0, 9 ,\"8\",7,600,41\r\n",
    );
    assert_eq!(tips(&program), [[1.0, 2.0, 3.0], [7.0, 8.0, 9.0]]);
    let [first, second] = program.moves() else { panic!() };
    assert_eq!((first.kind(), first.line(), first.feed()), (MoveKind::Rapid, 2, None));
    assert_eq!((second.kind(), second.line(), second.axis()), (MoveKind::Feed, 41, [0.0, -0.6, 0.8]));
    assert_eq!(second.feed(), Some(Feed { value: 600.0, unit: FeedUnit::MillimetresPerMinute }));
}

#[test]
fn rows_without_an_orientation_stand_upright() {
    assert_eq!(csv("x,y,z\n1,2,3\n").moves()[0].orientation(), Orientation::Vector([0.0, 0.0, 1.0]));
}

#[test]
fn rotary_words_are_kept_as_they_are() {
    let program = csv("x,y,z,phi1,phi2\n0,0,0,90,180\n0,0,0,90,-180\n0,0,0,90,540\n0,0,0,-90,0\n");
    let words: Vec<_> = program.moves().iter().map(verne_program::Move::orientation).collect();
    let rotary = |phi1, phi2| Orientation::Rotary { phi1, phi2 };
    assert_eq!(
        words,
        [rotary(FRAC_PI_2, PI), rotary(FRAC_PI_2, -PI), rotary(FRAC_PI_2, 3.0 * PI), rotary(-FRAC_PI_2, 0.0)]
    );
    assert_near(program.moves()[0].axis(), [0.0, 1.0, 0.0]);
}

#[test]
fn rotary_words_may_lead_to_the_opposite_axis() {
    assert_eq!(csv("x,y,z,phi1,phi2\n0,0,0,90,0\n1,0,0,-90,0\n").moves().len(), 2);
    refused(Format::Csv, "x,y,z,i,j,k\n0,0,0,0,0,1\n1,0,0,0,0,-1\n", (3, 1, "1"), "opposite");
}

#[test]
fn a_turn_at_the_pole_is_a_move_of_its_own() {
    let program = csv("x,y,z,phi1,phi2,feed\n0,0,0,0,0,90\n0,0,0,0,45,90\n0,0,0,0,45,90\n");
    assert_eq!(program.moves().len(), 2);
    assert_eq!(program.moves()[1].feed(), Some(Feed { value: 90.0, unit: FeedUnit::DegreesPerMinute }));
    assert!(warnings(&program)[0].contains("without length"));
}

#[test]
fn rows_are_millimetres_unless_the_request_says_inches() {
    let options = ReadOptions { units: Some(Units::Inches), ..ReadOptions::default() };
    let program = read(Format::Csv, b"x,y,z,feed\n1,0,0,10\n2,0,0,10\n".as_slice(), &options).unwrap();
    assert_eq!(tips(&program), [[25.4, 0.0, 0.0], [50.8, 0.0, 0.0]]);
    assert_eq!(program.moves()[1].feed().unwrap().value, 254.0);
}

#[test]
fn further_columns_are_left_out_with_a_warning() {
    let program = csv("x,y,z,note\n1,2,3,\"a, b\"\n");
    assert_eq!(program.moves().len(), 1);
    assert_eq!(program.warnings().list[0].word, "note");
}

#[test]
fn the_row_of_names_tells_what_separates_the_columns() {
    let expected = csv("x,y,z,note\n1,2.5,3,a\n4,5,6,b\n");
    for separator in [";", "\t", " ; "] {
        let text = ["x,y,z,note", "1,2.5,3,\"a\"", "4,5,6,b\n"].join("\n").replace(',', separator);
        assert_eq!(tips(&csv(&text)), tips(&expected), "{separator}");
    }
    assert_eq!(csv("x;y;z;\"a, b, c, d, e\"\n1;2;3;\"4;5\"\n").moves().len(), 1);
    refused(Format::Csv, "x;y;z\n1;2\n", (2, 3, "2"), "2 values; accepted are 3");
    refused(Format::Csv, "x\ty\tz\n1\tq\t3\n", (2, 3, "q"), "finite number");
}

#[test]
fn a_decimal_comma_is_refused_by_name() {
    let detail = "a decimal comma; write 1.5";
    refused(Format::Csv, "x;y;z\n0;-1,5;3\n", (2, 3, "-1,5"), "a decimal comma; write -1.5");
    refused(Format::Csv, "x\ty\tz\n1,5\t2\t3\n", (2, 1, "1,5"), detail);
    refused(Format::Csv, "x,y,z\n\"1,5\",2,3\n", (2, 1, "1,5"), detail);
}

#[test]
fn csv_that_is_not_understood_is_refused_at_its_value() {
    use Format::Csv;
    refused(Csv, "1,2,3\n4,5,6\n", (1, 1, "1"), "name the columns");
    refused(Csv, "x,y\n1,2\n", (1, 1, "x"), "x, y and z");
    refused(Csv, "x,y,z,i,j\n1,2,3,0,0\n", (1, 1, "x"), "orientation");
    refused(Csv, "x,y,z,i,j,k,phi1,phi2\n", (1, 1, "x"), "twice");
    refused(Csv, "x,y,z,X\n1,2,3,4\n", (1, 7, "X"), "named twice");
    refused(Csv, "x,y,z\n1,2,3\n1,2\n", (3, 3, "2"), "2 values; accepted are 3");
    refused(Csv, "x,y,z\n1,2,3,4\n", (2, 7, "4"), "4 values");
    refused(Csv, "x,y,z\n1,NaN,3\n", (2, 3, "NaN"), "finite number");
    refused(Csv, "x,y,z\n1,2,inf\n", (2, 5, "inf"), "finite number");
    refused(Csv, "x,y,z\n1,2,1e999\n", (2, 5, "1e999"), "finite number");
    refused(Csv, "x,y,z\n1.5.2,2,3\n", (2, 1, "1.5.2"), "finite number");
    refused(Csv, "x,y,z\n1,,3\n", (2, 1, "1"), "x, y and z");
    refused(Csv, "x,y,z,kind\n1,2,3,retract\n", (2, 7, "retract"), "feed and rapid");
    refused(Csv, "x,y,z,feed\n1,2,3,0\n", (2, 7, "0"), "positive");
    refused(Csv, "x,y,z,line\n1,2,3,1.5\n", (2, 7, "1.5"), "whole number");
    refused(Csv, "x,y,z,i,j,k\n1,2,3,0,0,0\n", (2, 7, "0"), "(0, 0, 0)");
    refused(Csv, "x,y,z,phi1,phi2\n1,2,3,1e7,0\n", (2, 7, "1e7"), "degrees");
    refused(Csv, "x,y,z\n\"1,2,3\n4,5,6\n", (2, 1, ""), "quotes end in their row");
    refused(Csv, &format!("x,y,z\n1,2,3{}\n", ",".repeat(300)), (2, 1, ""), "at most 256 values");
}

#[test]
fn ndjson_rows_are_arrays_or_objects() {
    let program = ndjson(
        "[1, 2, 3, 0, -3, 4]\n\n{\"z\": 6, \"x\": 4, \"y\": 5, \"i\": 1, \"j\": 0, \"k\": 0, \
         \"kind\": \"rapid\", \"feed\": null, \"line\": 70}\r\n",
    );
    assert_eq!(tips(&program), [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    assert_eq!(program.moves()[0].axis(), [0.0, -0.6, 0.8]);
    assert_eq!((program.moves()[1].kind(), program.moves()[1].line()), (MoveKind::Rapid, 70));
    assert_eq!(ndjson("[0,0,0,90,0]").moves()[0].orientation().axis()[1], -1.0);
}

#[test]
fn ndjson_that_is_not_understood_is_refused_at_its_column() {
    use Format::Ndjson;
    refused(Ndjson, "[1, 2]\n", (1, 5, "2"), "3, 5 or 6 numbers");
    refused(Ndjson, "[0,0,0]\n[1, 2, 3, 4]\n", (2, 11, "4"), "3, 5 or 6 numbers");
    refused(Ndjson, "[1, 2, NaN]\n", (1, 8, "N"), "expected value");
    refused(Ndjson, "[1, 2, 1e999]\n", (1, 8, "1e999"), "out of range");
    refused(Ndjson, "\n{\"x\": 1, \"y\": 2}\n", (2, 15, "2"), "x, y and z");
    refused(Ndjson, "{\"x\": 1, \"x\": 2}\n", (1, 10, "\"x\""), "duplicate field");
    let names = "x, y, z; then i, j, k, or phi1, phi2";
    refused(Ndjson, "{\"x\":1,\"y\":2,\"z\":3,\"Phi1\":20}\n", (1, 20, "\"Phi1\""), names);
    refused(
        Ndjson,
        "{\"fed\":5,\"x\":1,\"y\":2,\"z\":3}\n",
        (1, 2, "\"fed\""),
        "unknown field `fed`; accepted",
    );
    refused(Ndjson, "{\"x\":1,\"y\":2,\"z\":3,\"kind\":\"plunge\"}\n", (1, 27, "\"plunge\""), "rapid");
    refused(Ndjson, "{\"x\":1,\"y\":2,\"z\":3", (1, 18, "3"), "EOF");
    refused(Ndjson, "7\n", (1, 1, "7"), "array");
    refused(Ndjson, "[1,2,3,0,0,0]\n", (1, 1, "i"), "(0, 0, 0)");
    refused(Ndjson, &format!("{{\"x\":{}\n", "[".repeat(5000)), (1, 6, ""), "f64");
}

#[test]
fn each_row_states_its_orientation_in_its_own_way() {
    let program =
        ndjson("[0,0,0]\n[1,0,0,90,0]\n[2,0,0,0,-3,4]\n{\"x\":3,\"y\":0,\"z\":0,\"phi1\":0,\"phi2\":0}\n");
    let orientations: Vec<_> = program.moves().iter().map(verne_program::Move::orientation).collect();
    let rotary = |phi1| Orientation::Rotary { phi1, phi2: 0.0 };
    let vector = Orientation::Vector;
    assert_eq!(
        orientations,
        [vector([0.0, 0.0, 1.0]), rotary(FRAC_PI_2), vector([0.0, -0.6, 0.8]), rotary(0.0)]
    );
    assert_eq!(program.warnings().total, 0);
    assert_eq!(csv("x,y,z,i,j,k\n0,0,0,0,-3,4\n1,0,0,,,\n").moves()[1].axis(), [0.0, 0.0, 1.0]);
}

#[test]
fn a_row_without_an_orientation_after_one_with_an_orientation_is_a_warning() {
    let program = ndjson("[0,0,0]\n[0,0,1,0,-3,4]\n[1,0,0]\n");
    assert_eq!(program.moves()[2].axis(), [0.0, 0.0, 1.0]);
    let warning = &program.warnings().list[0];
    assert_eq!(warning.line, 3);
    assert!(warning.detail.contains("(0, 0, 1)"), "{warning:?}");
}

#[test]
fn points_are_the_same_rows() {
    let text = "[0,0,0,0,0,1]\n{\"x\":1,\"y\":0,\"z\":0,\"i\":0,\"j\":1,\"k\":1,\"feed\":5}\n";
    let array = format!("[{}]", text.trim().replace('\n', ","));
    let rows: Vec<Row> = serde_json::from_str(&array).unwrap();
    assert_eq!(read_points(rows, &ReadOptions::default()).unwrap(), ndjson(text));
    let nan = Row { tip: [0.0, f64::NAN, 0.0], ..serde_json::from_str("[0,0,0]").unwrap() };
    let refused = read_points([nan; 50], &ReadOptions::default()).unwrap_err();
    assert_eq!((refused.errors.len(), refused.complete), (20, false));
    assert_eq!(place(&refused.errors[1]), (2, 1, "y"));
}
