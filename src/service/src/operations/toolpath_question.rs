//! A checked question about a tool path.

mod checks;

use std::collections::BTreeMap;
use std::sync::Arc;

use verne_program::{Program, ProgramErrors};
use verne_solver::machine::Drive;
use verne_solver::toolpath::{Deviation, OnLimit, PlanOptions};

use crate::operations::machine_registry::{IdentifiedMachine, MachineRegistry};
use crate::operations::program_motions::ProgramMotions;
use crate::operations::toolpath_cost::toolpath_cost;
use crate::operations::toolpath_question::checks::{check_request, standing_at};
use crate::wire::canonical_toolpath::CanonicalToolpath;
use crate::wire::degrees::from_degrees;
use crate::wire::error::OperationError;
use crate::wire::json::write_json;
use crate::wire::result_id::ResultId;
use crate::wire::start::Start;
use crate::wire::toolpath::{OnLimitName, RapidsName, Setup, TipName, ToolLengths, ToolpathRequest};

/// Begins the hash of every tool path. It changes when the bytes of the answer to the same question change.
const HASH_PREFIX: &[u8] = b"verne toolpath 2";

/// How far the tool leaves the part, if the request does not say, mm.
const CLEARANCE: f64 = 50.0;
/// Seconds in which the velocities of drives may change at corners, if the request does not say.
const DEFAULT_CYCLE: f64 = 0.004;

/// About the bytes of a request.
const REQUEST_BYTES: usize = 512;

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
    /// The machine.
    pub machine: Arc<IdentifiedMachine>,
    /// The request, with an empty program.
    pub request: CanonicalToolpath,
}

impl CheckedToolpath {
    /// Checks a request.
    ///
    /// # Errors
    ///
    /// All fields that cannot be used.
    pub(crate) fn new(request: &ToolpathRequest, machines: &MachineRegistry) -> Result<Self, OperationError> {
        let machine = check_request(request, machines)?;
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

    /// The length of every tool, if the request states one, mm.
    pub(crate) fn one_tool_length(&self) -> Option<f64> {
        match self.request.tool_length {
            Some(ToolLengths::One(length)) => Some(length),
            _ => None,
        }
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
            // It was checked with the request.
            start: start.and_then(|start| standing_at(&self.machine, &start).ok()),
            joint_rapids: *rapids == RapidsName::Joint,
            on_limit: match self.request.clearance {
                Some(clearance) => OnLimit::Retract { clearance, height: self.request.retract_z },
                None => OnLimit::Fail,
            },
            ..PlanOptions::default()
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
        hold_rotary: request.hold_rotary,
        tolerance: request.tolerance,
        pole: request.pole.unwrap_or(0.5 * request.tolerance.axis) + 0.0,
        rapids: request.rapids,
        start: request.start.map(Start::canonical),
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
