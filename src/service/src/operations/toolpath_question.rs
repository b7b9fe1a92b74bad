//! A checked question about a tool path.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;
use std::sync::Arc;

use verne_program::{Program, ProgramErrors, WorkOffset};
use verne_solver::machine::Drive;
use verne_solver::toolpath::{Deviation, OnLimit, PlanOptions};
use verne_solver::{MAX_INPUT, TableAngles};

use crate::operations::machine_registry::{IdentifiedMachine, MachineRegistry};
use crate::operations::program_motions::ProgramMotions;
use crate::operations::toolpath_cost::toolpath_cost;
use crate::wire::canonical_toolpath::{CanonicalToolpath, TableStart};
use crate::wire::degrees::from_degrees;
use crate::wire::error::OperationError;
use crate::wire::field_errors::{FieldErrors, is_tool_length};
use crate::wire::json::write_json;
use crate::wire::result_id::ResultId;
use crate::wire::toolpath::{
    OnLimitName, RapidsName, Setup, TipName, Tolerance, ToolLengths, ToolpathRequest,
};

/// Begins the hash of every tool path. It changes when the bytes of the answer to the same question change.
const HASH_PREFIX: &[u8] = b"verne toolpath 1";

/// About the bytes of a request.
const REQUEST_BYTES: usize = 512;

/// Finest and coarsest tolerances: of the tip, mm, of the axis, degrees, and of rapids, mm.
const TOLERANCES: [(&str, [f64; 2], &str); 3] = [
    ("/tolerance/tip", [1e-5, 100.0], "mm"),
    ("/tolerance/axis", [1e-5, 10.0], "degrees"),
    ("/tolerance/rapid", [1e-5, 1000.0], "mm"),
];

/// How far the tool leaves the part, if the request does not say, mm.
const CLEARANCE: f64 = 50.0;
const LEAST_CLEARANCE: f64 = 0.1;
/// Seconds in which the velocities of drives may change at corners: shortest and longest, and the default.
const CYCLES: RangeInclusive<f64> = 1e-6..=1.0;
const DEFAULT_CYCLE: f64 = 0.004;

/// Most tools in a table of lengths.
const MOST_TOOLS: usize = 1000;

/// A question about a tool path that has an answer.
#[derive(Clone, Debug)]
pub(crate) struct ToolpathQuestion {
    /// The machine.
    pub machine: Arc<IdentifiedMachine>,
    /// The request with its default values.
    pub request: CanonicalToolpath,
    /// The id of the answer.
    pub id: ResultId,
    /// Estimated work, seconds of one core.
    pub cost: f64,
}

/// A request whose numbers are checked, without its program.
#[derive(Clone, Debug)]
pub(crate) struct CheckedToolpath {
    machine: Arc<IdentifiedMachine>,
    /// The request, with an empty program.
    request: CanonicalToolpath,
}

impl CheckedToolpath {
    /// Checks a request.
    ///
    /// # Errors
    ///
    /// All fields that cannot be used.
    pub(crate) fn new(request: &ToolpathRequest, machines: &MachineRegistry) -> Result<Self, OperationError> {
        let mut faults = FieldErrors::default();
        check_frames(request, &mut faults);
        check_tools(request, &mut faults);
        check_tolerances(request, &mut faults);
        check_retraction(request, &mut faults);
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
        let request = canonical(request, &machine);
        Ok(Self { machine, request })
    }

    /// The question about a program. Its work is not estimated yet.
    pub(crate) fn question(self, program: ResultId) -> ToolpathQuestion {
        ToolpathQuestion::of(self.machine, CanonicalToolpath { program, ..self.request }, 0.0)
    }
}

impl ToolpathQuestion {
    /// The question of a checked request.
    pub(crate) fn of(machine: Arc<IdentifiedMachine>, request: CanonicalToolpath, cost: f64) -> Self {
        // Writing these fields to memory cannot fail.
        let text = write_json(&request, REQUEST_BYTES).unwrap_or_default();
        let id = ResultId::of_text(HASH_PREFIX, &machine.id, &machine.data().description, &text);
        Self { machine, request, id, cost }
    }

    /// Checks the program, and estimates the work. It takes some 0.1 s for a million moves: call it on the compute
    /// pool.
    ///
    /// # Errors
    ///
    /// [`OperationError::ProgramFaults`]
    pub(crate) fn with_program(self, program: &Arc<Program>) -> Result<Self, OperationError> {
        let motions = self.motions(program).map_err(OperationError::ProgramFaults)?;
        let cost = toolpath_cost(&motions, &self.request.tolerance);
        Ok(Self { cost, ..self })
    }

    /// The motions of the program.
    pub(crate) fn motions(&self, program: &Arc<Program>) -> Result<ProgramMotions, ProgramErrors> {
        ProgramMotions::new(Arc::clone(program), &self.request, &self.machine)
    }

    /// Seconds in which the velocities of drives may change at corners.
    pub(crate) fn cycle(&self) -> f64 {
        self.request.cycle.unwrap_or(DEFAULT_CYCLE)
    }

    /// What the plan keeps to.
    pub(crate) fn plan_options(&self) -> PlanOptions {
        let CanonicalToolpath { tolerance, pole, rapids, start, tool_radius, .. } = &self.request;
        let radius = tool_radius.unwrap_or_default();
        // The lowest point of a ball is its radius below its centre, whatever its inclination.
        let (tool_radius, raise) = match self.request.tip {
            TipName::End => (radius, 0.0),
            TipName::Centre => (0.0, radius),
        };
        PlanOptions {
            tolerance: Deviation { tip: tolerance.tip, axis: from_degrees(tolerance.axis) },
            rapid_tolerance: tolerance.rapid,
            pole: from_degrees(*pole),
            tool_radius,
            table_clearance: self.request.table_clearance.map(|clearance| clearance + raise),
            start: start.map(|start| TableAngles {
                theta1: from_degrees(start.theta1),
                theta2: from_degrees(start.theta2),
            }),
            joint_rapids: *rapids == RapidsName::Joint,
            on_limit: match self.request.clearance {
                Some(clearance) => OnLimit::Retract { clearance, height: self.request.retract_z },
                None => OnLimit::Fail,
            },
            ..PlanOptions::default()
        }
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

/// The request with its default values, without -0 and without fields that have no effect.
fn canonical(request: &ToolpathRequest, machine: &IdentifiedMachine) -> CanonicalToolpath {
    let [table_clearance, radius] = machine.canonical_clearance(request.table_clearance, request.tool_radius);
    let ball = (request.tip == TipName::Centre).then_some(request.tool_radius + 0.0);
    let tool_length = match &request.tool_length {
        Some(ToolLengths::One(length)) => Some(ToolLengths::One(length + 0.0)),
        Some(ToolLengths::Table(table)) => {
            Some(ToolLengths::Table(table.iter().map(|(number, length)| (*number, length + 0.0)).collect()))
        }
        None => None,
    };
    let retracts = request.on_limit == OnLimitName::Retract;
    let drives = machine.data().drives;
    let accelerates = |drive: &Drive| drive.acceleration.is_some();
    let is_accelerating = drives.is_some_and(|drives| drives.of_joints().iter().any(accelerates));
    CanonicalToolpath {
        program: ResultId::from(blake3::Hash::from([0; 32])),
        setup: positive_zeros(&request.setup),
        offsets: request
            .offsets
            .iter()
            .map(|(name, setup)| (name.clone(), positive_zeros(setup)))
            .collect::<BTreeMap<_, _>>(),
        tool_length,
        length_before: request.length_before,
        tool_radius: ball.or(radius),
        tip: request.tip,
        orientation: request.orientation,
        tolerance: request.tolerance,
        pole: request.pole.unwrap_or(0.5 * request.tolerance.axis) + 0.0,
        rapids: request.rapids,
        start: request
            .start
            .map(|start| TableStart { theta1: start.theta1 + 0.0, theta2: start.theta2 + 0.0 }),
        table_clearance,
        drives: drives.as_ref().map(Into::into),
        cycle: is_accelerating.then(|| request.cycle.unwrap_or(DEFAULT_CYCLE)),
        on_limit: request.on_limit,
        clearance: retracts.then_some(request.clearance.unwrap_or(CLEARANCE) + 0.0),
        retract_z: request.retract_z.filter(|_| retracts).map(|z| z + 0.0),
    }
}

fn positive_zeros(setup: &Setup) -> Setup {
    let Setup { x, y, z, a, b, c } = *setup;
    Setup { x: x + 0.0, y: y + 0.0, z: z + 0.0, a: a + 0.0, b: b + 0.0, c: c + 0.0 }
}
