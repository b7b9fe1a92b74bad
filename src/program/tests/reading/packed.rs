//! The canonical bytes of a program.

use verne_program::packed::{UnpackError, unpack, write};
use verne_program::{Format, Program, ReadOptions, read};

use crate::apt;

const TEXT: &str = "PARTNO/WITH EVERYTHING\nUNITS/INCHES\nLOADTL/1,LENGTH,2.5\nSPINDL/900,RPM,CLW\nCOOLNT/MIST\n\
                    DELAY/2\nWHATEVER/1\nFROM/0,0,9\nGOHOME\nRAPID\nGOTO/1,0,0\nFEDRAT/.125,IPR\n\
                    CIRCLE/0,0,0,0,0,1,1.,TIMES,2\nGOTO/0,1,2,0,1,1\n\
                    CYCLE/DRILL,DEPTH,.5,CLEAR,.1\nGOTO/3,3,3\nCYCLE/OFF\nSTOP\nFINI\n";

fn bytes_of(program: &Program) -> Vec<u8> {
    let mut bytes = Vec::new();
    write(program, &mut bytes).unwrap();
    bytes
}

fn rows() -> Program {
    let text = "x,y,z,phi1,phi2,feed\n0.1,0.2,0.3,10,-400,90\n0.1,0.2,0.3,0,7,1e-300\n";
    read(Format::Csv, text.as_bytes(), &ReadOptions::default()).unwrap()
}

#[test]
fn a_program_comes_back_to_the_last_bit() {
    for program in [apt(TEXT), rows()] {
        assert_eq!(unpack(bytes_of(&program).as_slice()).unwrap(), program);
    }
}

#[test]
fn equal_programs_have_equal_bytes_whatever_their_line_breaks() {
    assert_eq!(bytes_of(&apt(TEXT)), bytes_of(&apt(&TEXT.replace('\n', "\r\n"))));
    assert_ne!(bytes_of(&apt(TEXT)), bytes_of(&apt(&TEXT.replace("GOTO/1,0,0", "GOTO/1,0,0.0001"))));
}

#[test]
fn a_move_takes_about_60_bytes() {
    let text = (0..1000).map(|n| format!("[{n}.5,0,300,0.1,0.2,0.3]\n")).collect::<Vec<_>>().concat();
    let program = read(Format::Ndjson, text.as_bytes(), &ReadOptions::default()).unwrap();
    assert!(bytes_of(&program).len() < 70_000);
}

#[test]
fn cut_off_and_foreign_bytes_are_refused() {
    let bytes = bytes_of(&apt(TEXT));
    for end in 0..bytes.len() {
        assert!(unpack(&bytes[..end]).is_err(), "{end}");
    }
    let mut foreign = bytes.clone();
    foreign[7] ^= 1;
    assert!(matches!(unpack(foreign.as_slice()), Err(UnpackError::Bytes(_))));
    assert!(unpack(b"{}".as_slice()).is_err());
}

#[test]
fn damaged_numbers_are_refused_or_make_a_program_that_packs_again() {
    let bytes = bytes_of(&apt(TEXT));
    for at in 0..bytes.len() {
        for flip in [0x01, 0x80, 0xFF] {
            let mut damaged = bytes.clone();
            damaged[at] ^= flip;
            if let Ok(program) = unpack(damaged.as_slice()) {
                let finite =
                    |one: &verne_program::Move| one.tip().iter().chain(&one.axis()).all(|n| n.is_finite());
                assert!(program.moves().iter().all(finite), "{at}");
                assert!(program.bounds().is_some());
                assert_eq!(unpack(bytes_of(&program).as_slice()).unwrap(), program);
            }
        }
    }
}
