//! Tilted planes: G68.2, G53.1 and G69.

use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::builder::{ProgrammedFeed, Target};
use crate::error::ProgramError;
use crate::event::EventKind;
use crate::gcode::block::Block;
use crate::gcode::codes::Codes;
use crate::gcode::coordinates::{AXES, length_of, to_program};
use crate::gcode::position::Position;
use crate::gcode::state::State;
use crate::gcode::tilted_plane::TiltedPlane;
use crate::gcode::vocabulary::{Group, Meaning};
use crate::moves::MoveKind;
use crate::orientation::{Orientation, unit};

/// Does what G68.2, G69 and G53.1 of a block say.
pub(crate) fn apply(state: &mut State, block: &Block<'_>, codes: &Codes<'_, '_>) -> Result<(), ProgramError> {
    match codes.get(Group::Tilt) {
        Some(Meaning::Tilt) => begin(state, block, codes)?,
        Some(_) if state.tilt.is_some() => switch(state, block, None, "G69")?,
        _ => {}
    }
    if codes.get(Group::Once) == Some(Meaning::Align) {
        align(state, block, codes)?;
    }
    Ok(())
}

/// G68.2: the plane's origin X, Y, Z in the program's frame and its Euler angles I, J, K about z, x and z.
fn begin(state: &mut State, block: &Block<'_>, codes: &Codes<'_, '_>) -> Result<(), ProgramError> {
    if state.cycle.is_some() {
        let detail = "a tilted plane cannot begin within a cycle; write G80 before it";
        return Err(codes.fault(block, Group::Tilt, detail.to_owned()));
    }
    for letter in [b'P', b'Q', b'R'] {
        if let Some(word) = block.take(letter)
            && (letter != b'P' || word.value != 0.0)
        {
            let detail =
                "this kind of tilted plane is not read; accepted is G68.2 X Y Z I J K with Euler angles";
            return Err(block.fault_at(word, detail.to_owned()));
        }
    }
    let text = block.text_of(b"GXYZIJK");
    let mut origin = [0.0; 3];
    for (letter, value) in AXES.into_iter().zip(&mut origin) {
        *value = length_of(state, block, letter)?.unwrap_or(0.0);
    }
    let mut rotation = Matrix3::identity();
    for (letter, axis) in
        [b'I', b'J', b'K'].into_iter().zip([Vector3::z_axis(), Vector3::x_axis(), Vector3::z_axis()])
    {
        if let Some(word) = block.take(letter) {
            rotation *= Rotation3::from_axis_angle(&axis, (word.value % 360.0).to_radians()).matrix();
        }
    }
    switch(state, block, Some(TiltedPlane { origin: origin.into(), rotation, aligned: false }), &text)
}

/// Begins or ends a plane. The tool stands still, so its coordinates change.
fn switch(
    state: &mut State,
    block: &Block<'_>,
    tilt: Option<TiltedPlane>,
    text: &str,
) -> Result<(), ProgramError> {
    let point = state.position.point().map(|point| to_program(state, point));
    state.position = match point {
        Some(point) => Position::at(tilt.map_or(point, |tilt| tilt.point_from_program(point))),
        None => Position { coordinates: [None; 3], ..state.position },
    };
    let event = EventKind::TiltedPlane { on: tilt.is_some() };
    state.tilt = tilt;
    state.builder.event(block.line, event, text).map_err(|detail| block.fault(detail))
}

/// G53.1: the tool's axis turns to the normal of the plane.
fn align(state: &mut State, block: &Block<'_>, codes: &Codes<'_, '_>) -> Result<(), ProgramError> {
    let Some(tilt) = &mut state.tilt else {
        let detail = "G53.1 needs a tilted plane; accepted is G68.2 before it";
        return Err(codes.fault(block, Group::Once, detail.to_owned()));
    };
    tilt.aligned = true;
    let normal = unit(tilt.direction_to_program([0.0, 0.0, 1.0])).unwrap_or([0.0, 0.0, 1.0]);
    if state.axis.orientation(state.builder.options.rotary_sense).axis() == normal {
        return Ok(());
    }
    state.axis.set_vector(normal);
    let Some(point) = state.position.point() else { return Ok(()) };
    let detail = "G53.1 turns the tool: the tip is taken to stand still";
    state.builder.diagnostics.warn(block.line, "G53.1", detail);
    let target = Target {
        line: block.line,
        kind: MoveKind::Rapid,
        tip: to_program(state, point),
        orientation: Orientation::Vector(normal),
        feed: ProgrammedFeed::default(),
    };
    state.builder.line(target).map_err(|detail| block.fault(detail))
}
