//! An example of each operation that answers tables: CSV, and the answer that the solver computes.

use serde_json::{Value, json};
use verne_rows::Format;
use verne_solver::workspace::Unobserved;

use crate::operations::contains_columns::ContainsColumns;
use crate::operations::error_budget_columns::ErrorBudgetColumns;
use crate::operations::forward_columns::ForwardColumns;
use crate::operations::inverse_columns::InverseColumns;
use crate::operations::machine_registry::MachineRegistry;
use crate::operations::row_stream::{RowAnswer, RowStream};
use crate::wire::error::OperationError;
use crate::wire::error_budget::ErrorBudgetRowsQuery;
use crate::wire::machine_ref::MachineRef;
use crate::wire::query_string::parse_query;
use crate::wire::row_query::{ContainsRowsQuery, FkRowsQuery, IkRowsQuery};

/// Greatest size of a message of Arrow; the examples have none.
const MESSAGE_BYTES: usize = 1;

/// Writes the examples into the document.
pub(crate) fn write_table_examples(document: &mut Value) {
    let machines = MachineRegistry::default();
    let ik = parse_query::<IkRowsQuery>("").and_then(|query| InverseColumns::new(&query.into(), &machines));
    let fk = parse_query::<FkRowsQuery>("").and_then(|query| ForwardColumns::new(&query.into(), &machines));
    let contains = parse_query::<ContainsRowsQuery>("");
    let contains = contains.and_then(|query| ContainsColumns::new(&query.into(), &machines));
    let budget = parse_query::<ErrorBudgetRowsQuery>("parameter_tolerances={\"L1\":0.02}")
        .and_then(|query| ErrorBudgetColumns::new(&query.into_request(MachineRef::default())?, &machines));
    write(document, "/error-budget", budget, "x,y,z,i,j,k\n100,50,150,0,0,1\n");
    write(document, "/ik/batch", ik, "id,x,y,z,i,j,k\nA,100,50,150,0,0,1\nB,100,,150,0,0,1\n");
    write(document, "/fk/batch", fk, "rho1,rho2,rho3,theta1,theta2\n674,685,250,0,0\n");
    write(document, "/workspace/contains", contains, "x,y,z\n100,50,1200\n0,0,5000\n");
}

fn write(
    document: &mut Value,
    path: &str,
    answer: Result<impl RowAnswer + 'static, OperationError>,
    csv: &str,
) {
    let answer = answer.and_then(|answer| answered(Box::new(answer), csv));
    // The tests report an error as an outdated example.
    let answer = answer.unwrap_or_else(|error| error.to_string());
    let operation = &mut document["paths"][format!("{path}.csv")]["post"];
    operation["requestBody"]["content"]["text/csv"]["example"] = json!(csv);
    operation["responses"]["200"]["content"]["text/csv"]["example"] = json!(answer);
}

fn answered(answer: Box<dyn RowAnswer>, csv: &str) -> Result<String, OperationError> {
    let mut stream = RowStream::new(answer, Format::Csv, Format::Csv, MESSAGE_BYTES);
    stream.push(csv.as_bytes());
    stream.end();
    let mut text = Vec::new();
    while let Some(bytes) = stream.next(&Unobserved)? {
        text.extend(bytes);
    }
    String::from_utf8(text).map_err(|_| OperationError::Internal)
}
