//! A checked question about dexterity.

use std::sync::Arc;

use verne_solver::workspace::dexterity::DexterityRequest;

use crate::operations::machine_registry::{IdentifiedMachine, MachineRegistry};
use crate::wire::degrees::from_degrees;
use crate::wire::dexterity::{CanonicalDexterity, DexterityBody, Inclinations};
use crate::wire::error::OperationError;
use crate::wire::field_errors::{FieldErrors, is_angle};
use crate::wire::result_id::ResultId;

/// About the seconds that a point takes.
const POINT_COST: f64 = 1e-4;

/// Begins the hash of every map. It changes when the bytes of the answer to the same question change.
const HASH_PREFIX: &[u8] = b"verne dexterity 2";

/// A question about dexterity that has an answer.
#[derive(Clone, Debug)]
pub(crate) struct DexterityQuestion {
    /// The machine.
    pub machine: Arc<IdentifiedMachine>,
    /// The request with its default values.
    pub request: CanonicalDexterity,
    /// The id of the answer.
    pub id: ResultId,
}

impl DexterityQuestion {
    /// Checks a request.
    pub(crate) fn new(request: &DexterityBody, machines: &MachineRegistry) -> Result<Self, OperationError> {
        let mut faults = FieldErrors::default();
        faults.tool_length(request.tool_length);
        faults.clearance(request.table_clearance, request.tool_radius, None);
        faults.angle("/phi2", Some(request.phi2));
        let Inclinations { from, to } = request.phi1;
        faults.angle("/phi1/from", Some(from));
        faults.angle("/phi1/to", Some(to));
        if is_angle(from) && is_angle(to) && !(0.0..=360.0).contains(&(to - from)) {
            faults.add("/phi1", "must run from the lesser angle to the greater, by at most 360 degrees");
        }
        faults.cell(request.cell);
        let resolved = machines.resolve(&request.machine);
        faults.into_result()?;
        let machine = resolved?;
        let [table_clearance, tool_radius] =
            machine.canonical_clearance(request.table_clearance, request.tool_radius);
        let request = CanonicalDexterity {
            tool_length: request.tool_length + 0.0,
            table_clearance,
            tool_radius,
            phi1: Inclinations { from: from + 0.0, to: to + 0.0 },
            phi2: request.phi2 + 0.0,
            cell: request.cell,
        };
        Ok(Self::of(machine, request))
    }

    /// The question of a checked request.
    pub(crate) fn of(machine: Arc<IdentifiedMachine>, request: CanonicalDexterity) -> Self {
        let CanonicalDexterity { tool_length, table_clearance, tool_radius, phi1, phi2, cell } = request;
        let numbers = [tool_length, phi1.from, phi1.to, phi2, cell];
        let numbers = numbers.into_iter().chain(table_clearance).chain(tool_radius);
        Self { id: machine.result_id(HASH_PREFIX, numbers), machine, request }
    }

    /// Estimated work, seconds of one core. The grid is as wide as the machine. Across that width, the table turns what
    /// the strokes reach.
    pub(crate) fn cost(&self) -> f64 {
        let strokes = self.machine.data().limits.stroke;
        let stroke = strokes.iter().map(|[low, high]| high - low).fold(0.0, f64::max);
        let (wide, across) = (self.machine.longest(), self.machine.longest().max(stroke));
        POINT_COST * wide * across * across / self.request.cell.powi(3)
    }
}

impl From<&CanonicalDexterity> for DexterityRequest {
    fn from(request: &CanonicalDexterity) -> Self {
        Self {
            tool_length: request.tool_length,
            table_clearance: request.table_clearance,
            tool_radius: request.tool_radius.unwrap_or_default(),
            phi2: from_degrees(request.phi2),
            phi1: [request.phi1.from, request.phi1.to].map(from_degrees),
            cell: request.cell,
        }
    }
}
