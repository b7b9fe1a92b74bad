//! `verne error-budget`: the error budget of a pose, or of each row of a file.

use std::io::Write;
use std::process::ExitCode;

use crate::operations::error_budget::answer_one;
use crate::operations::machine_registry::MachineRegistry;
use crate::process::cli::answer::{exit_status, machine, with_flags};
use crate::process::cli::one_or_batch::OneOrBatch;
use crate::process::cli::terminal::Terminal;
use crate::process::cli::words::error_budgets;
use crate::wire::error_budget::{ErrorBudgetQuery, ErrorBudgetRowsQuery};

/// The arguments.
pub(crate) type ErrorBudgetCommand = OneOrBatch<ErrorBudgetQuery, ErrorBudgetRowsQuery>;

/// Writes the answer of the HTTP service to `out`, or the answers to rows. The exit status is 3 if a row has no
/// solution within the limits.
pub(crate) fn run(
    command: ErrorBudgetCommand,
    out: &mut impl Write,
    err: &mut impl Write,
    terminal: Option<Terminal>,
) -> Result<ExitCode, String> {
    let one = match command {
        OneOrBatch::One(one) => one,
        OneOrBatch::Batch(batch) => return batch.run(out, err, terminal.is_some()),
    };
    let machine = machine(&one.query.machine)?;
    let (request, pose) = one.query.into_request(machine);
    let answer = answer_one(&request, pose, &MachineRegistry::default()).map_err(with_flags)?;
    let json = serde_json::to_value(&answer).map_err(|error| error.to_string())?;
    one.format.write(&json, error_budgets::pose, out, terminal)?;
    Ok(exit_status(answer.report.counts.ok == 1))
}
