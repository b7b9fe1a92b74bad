//! The checks of a request's fields.

use std::ops::RangeInclusive;
use std::sync::Arc;

use verne_program::WorkOffset;
use verne_solver::toolpath::Start as SolverStart;
use verne_solver::{KinematicsError, MAX_INPUT, Machine, TableAngles};

use crate::operations::machine_registry::{IdentifiedMachine, MachineRegistry};
use crate::wire::degrees::{from_degrees, to_degrees};
use crate::wire::error::OperationError;
use crate::wire::field_errors::{FieldErrors, is_tool_length};
use crate::wire::fixed_array::FixedArray;
use crate::wire::start::Start;
use crate::wire::toolpath::{OnLimitName, OrientationName, Setup, Tolerance, ToolLengths, ToolpathRequest};

/// Finest and coarsest tolerances: of the tip, mm, of the axis, degrees, and of rapids, mm.
const TOLERANCES: [(&str, [f64; 2], &str); 3] = [
    ("/tolerance/tip", [1e-5, 100.0], "mm"),
    ("/tolerance/axis", [1e-5, 10.0], "degrees"),
    ("/tolerance/rapid", [1e-5, 1000.0], "mm"),
];

/// Least way of the tool along its axis, mm.
const LEAST_CLEARANCE: f64 = 0.1;
/// Seconds in which the velocities of drives may change at corners.
const CYCLES: RangeInclusive<f64> = 1e-6..=1.0;

/// Most tools in a table of lengths.
const MOST_TOOLS: usize = 1000;

/// Checks a request, and finds its machine.
///
/// # Errors
///
/// All fields that cannot be used.
pub(super) fn check_request(
    request: &ToolpathRequest,
    machines: &MachineRegistry,
) -> Result<Arc<IdentifiedMachine>, OperationError> {
    let mut faults = FieldErrors::default();
    check_frames(request, &mut faults);
    check_tools(request, &mut faults);
    check_tolerances(request, &mut faults);
    check_retraction(request, &mut faults);
    check_hold(request, &mut faults);
    if request.cycle.is_some_and(|cycle| !CYCLES.contains(&cycle)) {
        let detail = format!("must be a number from {:e} to {} s", CYCLES.start(), CYCLES.end());
        faults.add("/cycle", detail);
    }
    if let Some(start) = &request.start {
        start.check(&mut faults);
    }
    let machine = machines.resolve(&request.machine);
    faults.into_result()?;
    let machine = machine?;
    let mut faults = FieldErrors::default();
    if let Some(start) = &request.start {
        check_start(start, &machine, &mut faults);
    }
    faults.into_result()?;
    Ok(machine)
}

/// The joints of a start.
pub(super) fn standing_at(machine: &Machine, start: &Start) -> Result<SolverStart, KinematicsError> {
    let [theta1, theta2] = [start.theta1, start.theta2].map(from_degrees);
    SolverStart::new(machine, start.rho.0, TableAngles { theta1, theta2 })
}

/// The machine cannot stand outside its strokes and ranges. The other limits are reported with the first line.
fn check_start(start: &Start, machine: &Machine, faults: &mut FieldErrors) {
    let limits = &machine.data().limits;
    let FixedArray(rho) = start.rho;
    let mut is_inside = true;
    for (i, (rho, [low, high])) in rho.into_iter().zip(limits.stroke).enumerate() {
        if !(low..=high).contains(&rho) {
            let detail = format!("is outside the stroke of slider {}: {low} to {high} mm", i + 1);
            faults.add(format!("/start/rho/{i}"), detail);
            is_inside = false;
        }
    }
    let ranges = [("theta1", start.theta1, Some(limits.tilt)), ("theta2", start.theta2, limits.rotary)];
    for (name, theta, range) in ranges {
        if let Some([low, high]) = range
            && !(low..=high).contains(&from_degrees(theta))
        {
            let [low, high] = [low, high].map(to_degrees);
            faults.add(format!("/start/{name}"), format!("is outside its range: {low} to {high} degrees"));
        }
    }
    if is_inside && standing_at(machine, start).is_err() {
        faults
            .add("/start/rho", "leaves the platform no place in the working mode: ask /fk for these sliders");
    }
}

/// Only about the table's own axis are rotary words angles of the table.
fn check_hold(request: &ToolpathRequest, faults: &mut FieldErrors) {
    if !request.hold_rotary {
        return;
    }
    if request.orientation == Some(OrientationName::Vector) {
        faults.add("/hold_rotary", "is not allowed with orientation vector, which uses no rotary words");
    }
    let frames = request.offsets.values().chain([&request.setup]);
    if frames.into_iter().any(|frame| frame.a != 0.0 || frame.b != 0.0) {
        let detail = "is allowed only where a and b of setup and offsets are 0: in an inclined frame the program's C \
                      is no angle of the table";
        faults.add("/hold_rotary", detail);
    }
}

fn check_frames(request: &ToolpathRequest, faults: &mut FieldErrors) {
    check_frame("/setup", &request.setup, faults);
    for (name, setup) in &request.offsets {
        let pointer = format!("/offsets/{}", name.replace('~', "~0").replace('/', "~1"));
        match name.parse::<WorkOffset>() {
            Err(detail) => faults.add(pointer, detail),
            Ok(offset) if offset.name() != name => {
                faults.add(pointer, format!("write {}", offset.name()));
            }
            Ok(offset) if offset == WorkOffset::default() && request.setup != Setup::default() => {
                faults.add(pointer, "is the frame that setup states too: give one of them");
            }
            Ok(_) => check_frame(&pointer, setup, faults),
        }
    }
}

fn check_frame(pointer: &str, setup: &Setup, faults: &mut FieldErrors) {
    for (name, length) in [("x", setup.x), ("y", setup.y), ("z", setup.z)] {
        faults.length(&format!("{pointer}/{name}"), length);
    }
    for (name, angle) in [("a", setup.a), ("b", setup.b), ("c", setup.c)] {
        faults.angle(&format!("{pointer}/{name}"), Some(angle));
    }
}

fn check_tools(request: &ToolpathRequest, faults: &mut FieldErrors) {
    match &request.tool_length {
        None => {}
        Some(ToolLengths::One(length)) => faults.tool_length(*length),
        Some(ToolLengths::Table(table)) => {
            if !(1..=MOST_TOOLS).contains(&table.len()) {
                faults
                    .add("/tool_length", format!("must have 1 to {MOST_TOOLS} entries, not {}", table.len()));
            }
            for (number, _) in table.iter().filter(|(_, length)| !is_tool_length(**length)) {
                let detail = format!("must be a number from 0 to {MAX_INPUT:e} mm");
                faults.add(format!("/tool_length/{number}"), detail);
            }
        }
    }
    if let Some(number) = request.length_before {
        match &request.tool_length {
            Some(ToolLengths::Table(table)) if table.contains_key(&number) => {}
            Some(ToolLengths::Table(_)) => {
                let detail = format!("must be an entry of tool_length, which has none for {number}");
                faults.add("/length_before", detail);
            }
            _ => faults.add("/length_before", "is allowed only with a table of lengths in tool_length"),
        }
    }
    faults.clearance(request.table_clearance, request.tool_radius, None);
}

fn check_tolerances(request: &ToolpathRequest, faults: &mut FieldErrors) {
    let Tolerance { tip, axis, rapid } = request.tolerance;
    for ((pointer, [finest, coarsest], unit), value) in TOLERANCES.into_iter().zip([tip, axis, rapid]) {
        if !(finest..=coarsest).contains(&value) {
            faults.add(pointer, format!("must be a number from {finest} to {coarsest} {unit}"));
        }
    }
    if let Some(pole) = request.pole
        && !(pole >= 0.0 && pole < axis)
    {
        faults.add("/pole", "must be at least 0 and less than tolerance.axis, of which it is a part");
    }
}

fn check_retraction(request: &ToolpathRequest, faults: &mut FieldErrors) {
    let fields = [("/clearance", request.clearance), ("/retract_z", request.retract_z)];
    for (pointer, value) in fields {
        match value {
            Some(_) if request.on_limit != OnLimitName::Retract => {
                faults.add(pointer, "is allowed only with on_limit retract");
            }
            // Nearer to the part, the turn of the table would cut a circle into it.
            Some(value)
                if pointer == "/clearance" && !(is_tool_length(value) && value >= LEAST_CLEARANCE) =>
            {
                faults.add(pointer, format!("must be a number from {LEAST_CLEARANCE} to {MAX_INPUT:e} mm"));
            }
            Some(value) => faults.length(pointer, value),
            None => {}
        }
    }
}
