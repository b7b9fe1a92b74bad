//! The candidates: the baselines and every entry point of the solver.

use verne_solver::{
    Machine, Margins, forward, forward_working, part, part_working, platform, platform_working, tool,
    tool_working,
};

use crate::harness::Candidate;
use crate::inputs::{Inputs, TOOL};
use crate::root_finders::FINDERS;
use crate::{eliminated_newton, newton};

/// The solver's row with which general root finders are compared.
pub(crate) const FORWARD: &str = "FK, all assembly modes";

/// All candidates in the order of the table, the baseline first.
pub(crate) fn all<'a>(machine: &'a Machine, inputs: &'a Inputs) -> Vec<Candidate<'a>> {
    let mut candidates = vec![
        Candidate::new(newton::NAME, &inputs.starts, |&(rho, start)| newton::forward(machine, rho, start)),
        Candidate::new("FK, Newton-Raphson, eliminated by hand", &inputs.starts, |&(rho, start)| {
            eliminated_newton::forward(machine, rho, start)
        }),
    ];
    candidates.extend(FINDERS.map(|(name, finder)| Candidate::new(name, &inputs.octics, finder)));
    candidates.extend([
        Candidate::new(FORWARD, &inputs.rho, |&rho| forward(machine, rho)).at_most(2.5),
        Candidate::new("FK, working mode", &inputs.rho, |&rho| forward_working(machine, rho)).at_most(0.6),
        Candidate::new("IK platform, working mode", &inputs.points, |&p| platform_working(machine, p))
            .at_most(0.25),
        Candidate::new("IK platform, all (16)", &inputs.points, |&p| platform(machine, p)).at_most(0.6),
        Candidate::new("IK part, working mode", &inputs.parts, |p| part_working(machine, p, TOOL))
            .at_most(0.6),
        Candidate::new("IK part, all (up to 24)", &inputs.parts, |p| part(machine, p, TOOL)).at_most(2.5),
        Candidate::new("IK tool, working mode", &inputs.tools, |&u| tool_working(machine, u, TOOL)),
        Candidate::new("IK tool, all (up to 24)", &inputs.tools, |&u| tool(machine, u, TOOL)),
        Candidate::new("margins of one pose, all", &inputs.tables, |(posture, table)| {
            Margins::of(machine, posture, Some(*table))
        })
        .at_most(0.5),
        Candidate::new("margins of one pose, all and the worst", &inputs.tables, |(posture, table)| {
            let margins = Margins::of(machine, posture, Some(*table));
            (margins, margins.worst(machine))
        })
        .at_most(0.5),
    ]);
    candidates
}
