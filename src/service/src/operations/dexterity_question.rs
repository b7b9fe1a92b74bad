//! A checked question about dexterity.

use std::sync::Arc;

use verne_solver::workspace::dexterity::DexterityRequest;

use crate::operations::registry::{Published, Registry};
use crate::wire::degrees::from_degrees;
use crate::wire::dexterity::{CanonicalDexterity, DexterityBody, Inclinations};
use crate::wire::error::OperationError;
use crate::wire::field_errors::{FieldErrors, is_angle};
use crate::wire::result_id::ResultId;
use crate::wire::workspace::over_table;

use crate::operations::workspace_question::longest;

/// Finest and coarsest grid, mm.
const CELLS: [f64; 2] = [1.0, 1000.0];

/// About the seconds that a point takes.
const POINT_COST: f64 = 1e-4;

/// Changes when the bytes do that the same question is answered with.
const LAYOUT: &[u8] = b"verne dexterity 2";

/// A question about dexterity that has an answer.
#[derive(Clone, Debug)]
pub(crate) struct DexterityQuestion {
    /// The machine.
    pub published: Arc<Published>,
    /// What is asked.
    pub request: CanonicalDexterity,
    /// The answer's id.
    pub id: ResultId,
}

impl DexterityQuestion {
    /// Checks a request.
    pub(crate) fn new(asked: &DexterityBody, machines: &Registry) -> Result<Self, OperationError> {
        let mut faults = FieldErrors::default();
        faults.tool_length(asked.tool_length);
        faults.clearance(asked.table_clearance, asked.tool_radius, None);
        faults.angle("/phi2", Some(asked.phi2));
        let Inclinations { from, to } = asked.phi1;
        faults.angle("/phi1/from", Some(from));
        faults.angle("/phi1/to", Some(to));
        if is_angle(from) && is_angle(to) && !(0.0..=360.0).contains(&(to - from)) {
            faults.add("/phi1", "must run from the lesser angle to the greater, by at most 360 degrees");
        }
        let [finest, coarsest] = CELLS;
        if !(finest..=coarsest).contains(&asked.cell) {
            faults.add("/cell", format!("must be a number from {finest} to {coarsest} mm"));
        }
        let resolved = machines.resolve(&asked.machine);
        faults.into_result()?;
        let published = resolved?;
        let clearance = asked.table_clearance.or(published.machine.data().limits.table_clearance);
        let [table_clearance, tool_radius] = over_table(clearance, asked.tool_radius);
        let request = CanonicalDexterity {
            tool_length: asked.tool_length + 0.0,
            table_clearance,
            tool_radius,
            phi1: Inclinations { from: from + 0.0, to: to + 0.0 },
            phi2: asked.phi2 + 0.0,
            cell: asked.cell,
        };
        Ok(Self::of(published, request))
    }

    /// A question that was checked before.
    pub(crate) fn of(published: Arc<Published>, request: CanonicalDexterity) -> Self {
        let CanonicalDexterity { tool_length, table_clearance, tool_radius, phi1, phi2, cell } = request;
        // Questions without the table keep the ids that they had before it could be asked for.
        let numbers = [tool_length, phi1.from, phi1.to, phi2, cell];
        let numbers = numbers.into_iter().chain(table_clearance).chain(tool_radius);
        Self { id: published.result_id(LAYOUT, numbers), published, request }
    }

    /// Estimated work, seconds of one core. The grid is as wide as the machine; across that the table turns what the strokes
    /// reach.
    pub(crate) fn cost(&self) -> f64 {
        let machine = self.published.machine.data();
        let stroke = machine.limits.stroke.iter().map(|[low, high]| high - low).fold(0.0, f64::max);
        let (wide, across) = (longest(machine), longest(machine).max(stroke));
        POINT_COST * wide * across * across / self.request.cell.powi(3)
    }
}

impl From<&CanonicalDexterity> for DexterityRequest {
    fn from(asked: &CanonicalDexterity) -> Self {
        Self {
            tool_length: asked.tool_length,
            table_clearance: asked.table_clearance,
            tool_radius: asked.tool_radius.unwrap_or_default(),
            phi2: from_degrees(asked.phi2),
            phi1: [asked.phi1.from, asked.phi1.to].map(from_degrees),
            cell: asked.cell,
        }
    }
}
