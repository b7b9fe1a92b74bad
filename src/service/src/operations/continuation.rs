//! The solution of a row that continues from the row before, or the best one to start anew.

use std::cmp::Ordering;
use std::f64::consts::PI;

use verne_solver::axis::{POLE, Preimages, preimages, tool_axis};
use verne_solver::{Clearance, Machine, Margins, Posture, TableAngles, part_every_working, part_pose};

use crate::operations::batch_rows::{RowOutcome, outcome_of_refusal};
use crate::operations::jacobians::{RowJacobian, RowJacobians};
use crate::operations::part_row::{Candidate, Candidates, PartRow};
use crate::operations::table_angles::{ToolOrientation, WoundTable};

/// Angles that count as equal, rad: rounding does not choose between them.
const EQUAL: f64 = 1e-9;

/// What all rows of a batch share.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Setting<'a> {
    pub(crate) machine: &'a Machine,
    pub(crate) tool_length: f64,
    pub(crate) clearance: Option<&'a Clearance>,
    pub(crate) jacobians: Option<RowJacobians>,
}

/// Where the machine stands after a row.
#[derive(Clone, Debug)]
pub(crate) struct Standing {
    /// Tool axis in the part frame, of length 1.
    axis: [f64; 3],
    /// Whether phi1 is above zero; `None` at the pole.
    phi1_is_positive: Option<bool>,
    pub(crate) table: TableAngles,
    alpha: f64,
    /// alpha of the other working solutions with the same orientation.
    others: Vec<f64>,
}

/// The solution of a row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chosen {
    pub(crate) posture: Posture,
    pub(crate) orientation: ToolOrientation,
    pub(crate) table: WoundTable,
    /// Whether it does not continue from the row before.
    pub(crate) jump: bool,
}

impl Setting<'_> {
    /// The Jacobian of a solution, if the request asks for it.
    pub(crate) fn jacobian(&self, posture: &Posture, table: TableAngles) -> Option<Box<RowJacobian>> {
        self.jacobians.map(|jacobians| jacobians.of(self.machine, posture, table, self.tool_length))
    }

    /// The solution of a row that continues from where the machine stands, or a solution of the first row. Otherwise
    /// the outcome of the row.
    pub(crate) fn choose(
        &self,
        before: Option<&Standing>,
        row: &PartRow,
        candidates: &Candidates,
    ) -> Result<Chosen, RowOutcome> {
        let candidates = candidates.as_ref().map_err(|refusal| outcome_of_refusal(self.machine, *refusal))?;
        let chosen = match before {
            Some(before) => self.next(before, row, candidates),
            None => self.first(candidates),
        };
        // The solver refuses a row that has no solution.
        chosen.ok_or_else(|| RowOutcome::Invalid("has no solution".to_owned()))
    }

    /// A feasible solution if there is one, of these that with the least |theta2|, of equal ones that with phi1 >= 0.
    fn first(&self, candidates: &[Candidate]) -> Option<Chosen> {
        let all: Vec<_> = candidates.iter().map(|one| self.wound(one, [None, Some(0.0)])).collect();
        self.best(&all, |angles| angles.theta2.abs())
    }

    /// The solution that continues. If there is none, or several (after the pole): a feasible one if there is one, of
    /// these that with the least turning, of equal ones that with phi1 >= 0.
    fn next(&self, before: &Standing, row: &PartRow, candidates: &[Candidate]) -> Option<Chosen> {
        let near = [Some(before.table.theta1), Some(before.table.theta2)];
        let mut all: Vec<_> = candidates.iter().map(|one| self.wound(one, near)).collect();
        for chosen in &mut all {
            chosen.jump = !before.continues(row, chosen, candidates);
        }
        if all.iter().any(|chosen| !chosen.jump) {
            all.retain(|chosen| !chosen.jump);
        }
        self.best(&all, |angles| before.turning(angles))
    }

    /// A candidate on the windings that are nearest to `near`.
    fn wound(&self, candidate: &Candidate, near: [Option<f64>; 2]) -> Chosen {
        let Candidate { orientation, posture } = *candidate;
        let table = orientation.wound(self.machine, posture.pose.alpha, near);
        Chosen { posture, orientation, table, jump: false }
    }

    /// The first of the best. The margins are computed only if there is a choice.
    fn best(&self, all: &[Chosen], turning: impl Fn(&TableAngles) -> f64) -> Option<Chosen> {
        if let [only] = all {
            return Some(*only);
        }
        let ranked = all.iter().map(|chosen| {
            let angles = chosen.table.angles();
            let margins = Margins::above_table(self.machine, &chosen.posture, Some(angles), self.clearance);
            (chosen, margins.feasible(), turning(&angles))
        });
        let best = ranked.min_by(|(a, a_feasible, a_turning), (b, b_feasible, b_turning)| {
            let is_negative = |chosen: &Chosen| chosen.orientation.inclination() < 0.0;
            b_feasible
                .cmp(a_feasible)
                .then(compare_angles(*a_turning, *b_turning))
                .then(is_negative(a).cmp(&is_negative(b)))
        });
        best.map(|(chosen, ..)| *chosen)
    }
}

fn compare_angles(a: f64, b: f64) -> Ordering {
    if (a - b).abs() <= EQUAL { Ordering::Equal } else { a.total_cmp(&b) }
}

impl Standing {
    /// After a row.
    pub(crate) fn after(row: &PartRow, chosen: &Chosen, candidates: &Candidates) -> Self {
        let alpha = chosen.posture.pose.alpha;
        let others = candidates.iter().flatten().filter(|other| other.orientation == chosen.orientation);
        Self {
            axis: row.axis,
            phi1_is_positive: (!row.is_pole()).then_some(chosen.orientation.inclination() > 0.0),
            table: chosen.table.angles(),
            alpha,
            others: others.map(|other| other.posture.pose.alpha).filter(|other| *other != alpha).collect(),
        }
    }

    /// With the platform and the table at rest.
    pub(crate) fn at(machine: &Machine, posture: &Posture, table: TableAngles, tool_length: f64) -> Self {
        let part = part_pose(machine, &posture.pose, table, tool_length);
        let orientation = ToolOrientation::of_radians([part.phi1, part.phi2]);
        let axis = tool_axis(part.phi1, part.phi2);
        let is_pole = matches!(preimages(axis), Some(Preimages::Free { .. }));
        let alpha = posture.pose.alpha;
        let target = orientation.at([part.x, part.y, part.z]);
        let others = part_every_working(machine, &target, tool_length).unwrap_or_default();
        Self {
            axis,
            phi1_is_positive: (!is_pole).then_some(orientation.inclination() > 0.0),
            table,
            alpha,
            others: others
                .iter()
                .map(|other| other.pose.alpha)
                .filter(|other| (other - alpha).abs() > EQUAL)
                .collect(),
        }
    }

    /// The angle through which the table's axes turn.
    fn turning(&self, to: &TableAngles) -> f64 {
        (to.theta1 - self.table.theta1).abs() + (to.theta2 - self.table.theta2).abs()
    }

    /// Whether one of the candidates of a row is on the same preimage, within half a turn, and in the same solution.
    fn continues(&self, row: &PartRow, chosen: &Chosen, candidates: &[Candidate]) -> bool {
        let turn = chosen.table.angles().theta2 - self.table.theta2;
        self.keeps_preimage(row, chosen)
            && turn.abs() <= PI + EQUAL
            && self.keeps_solution(chosen, candidates)
    }

    /// Whether phi1 has the sign that it had, or the other one if the way from axis to axis leads over the pole. At the
    /// pole phi1 has no sign.
    fn keeps_preimage(&self, row: &PartRow, chosen: &Chosen) -> bool {
        self.phi1_is_positive.is_none_or(|was_positive| {
            let is_positive = chosen.orientation.inclination() > 0.0;
            row.is_pole() || is_positive == (was_positive != leads_over_pole(self.axis, row.axis))
        })
    }

    /// Whether the working solution is the one that is nearest in alpha, and no other one of the row before is nearer
    /// to it: the solution of the row before would have ended otherwise.
    fn keeps_solution(&self, chosen: &Chosen, candidates: &[Candidate]) -> bool {
        let alpha = chosen.posture.pose.alpha;
        let distance = (alpha - self.alpha).abs();
        let mut same = candidates.iter().filter(|other| other.orientation == chosen.orientation);
        same.all(|other| (other.posture.pose.alpha - self.alpha).abs() >= distance)
            && self.others.iter().all(|other| (other - alpha).abs() >= distance)
    }
}

/// Whether the shorter great circle between two axes leads over the table's own axis, within the precision of axes.
fn leads_over_pole(a: [f64; 3], b: [f64; 3]) -> bool {
    let [x, y, z] = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let opposite_sides = a[0] * b[0] + a[1] * b[1] < 0.0;
    opposite_sides && z.abs() <= POLE * (x * x + y * y + z * z).sqrt()
}
