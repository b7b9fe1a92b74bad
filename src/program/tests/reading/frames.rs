//! Coordinate systems of CL text.

use crate::{apt, fault, mm, place, warnings};

const IDENTITY: &str = "CSYS/1.,0,0,0,0,1.,0,0,0,0,1.,0";
const TILTED: &str = "CSYS/0,0,1.,0,1.,0,0,0,0,1.,0,0";

#[test]
fn a_system_is_an_event_if_points_are_in_world_coordinates() {
    let program = mm(&format!("TRNTYP/WORLD,0,0,0\n{TILTED}\nGOTO/120.,24.9,-30.35,1.,0,0"));
    assert_eq!(program.events().len(), 2);
    assert_eq!(program.moves().len(), 1);
    // The order of the two words does not matter.
    assert_eq!(mm(&format!("{TILTED}\nTRNTYP/WORLD\nGOTO/0,0,0")).moves().len(), 1);
}

#[test]
fn points_in_a_system_of_their_own_are_refused_at_the_system() {
    let error = fault(&format!("TRNTYP/LOCAL\n{TILTED}\nGOTO/0,0,0\nGOTO/1,0,0"));
    assert_eq!(place(&error), (3, 1, "CSYS"));
    assert!(error.detail.contains("TRNTYP/WORLD"));
    assert_eq!(mm(&format!("TRNTYP/LOCAL\n{IDENTITY}\nGOTO/0,0,0")).moves().len(), 1);
}

#[test]
fn all_paths_of_a_file_have_one_machine_system() {
    let text = "MSYS/1,2,3,1,0,0,0,1,0\nGOTO/0,0,0\nMSYS/1,2,3,1,0,0,0,1,0\nGOTO/1,0,0";
    assert_eq!(mm(text).moves().len(), 2);
    let error = fault("MSYS/1,2,3,1,0,0,0,1,0\nGOTO/0,0,0\nMSYS/9,2,3,1,0,0,0,1,0\nGOTO/1,0,0");
    assert_eq!(place(&error), (4, 1, "MSYS"));
}

#[test]
fn a_shift_by_zero_is_accepted_and_another_refused() {
    assert_eq!(mm("ORIGIN/0,0,0.\nGOTO/0,0,0").moves().len(), 1);
    assert_eq!(place(&fault("TRANS/0,5,0")), (2, 9, "5"));
}

#[test]
fn the_unit_may_change_and_that_is_a_warning() {
    let program = apt("UNITS/MM\nGOTO/10,0,0\nUNITS/INCHES\nGOTO/1,0,0\nFINI\n");
    assert_eq!(program.moves()[1].tip(), [25.4, 0.0, 0.0]);
    assert_eq!(warnings(&program)[1], "the unit changes after the first motion");
    assert_eq!(fault("UNITS/CUBITS").word, "UNITS");
}
