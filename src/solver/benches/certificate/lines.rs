//! Questions and their boxes as JSON.

use serde_json::{Value, json};
use verne_solver::certificate::{PostureBox, Scope, Unproved};

use crate::questions::Question;
use crate::{Asked, certified};

/// Prints two lines for each question: all solutions, and those in the working mode.
pub(crate) fn print(asked: &[Asked]) {
    for asked in asked {
        for scope in [Scope::All, Scope::Working] {
            println!("{}", line(asked, scope));
        }
    }
}

fn line(asked: &Asked, scope: Scope) -> Value {
    let (machine, question) = asked;
    let (_, proof) = certified(asked, scope);
    let (g, table) = (&machine.data().geometry, &machine.data().table);
    let (kind, numbers) = match *question {
        Question::Forward(rho) => ("forward", rho.to_vec()),
        Question::Platform(p) => ("platform", p.to_vec()),
        Question::Tool([x, y, z], length) => ("tool", vec![x, y, z, length]),
        Question::Part(p, length) => ("part", vec![p.x, p.y, p.z, p.phi1, p.phi2, length]),
    };
    let complete = proof.as_ref().map(|proof| match proof.complete {
        Ok(()) => "complete".to_owned(),
        Err(reason) => format!("{reason:?}"),
    });
    json!({
        "geometry": {"D1": g.D1, "d1": g.d1, "D2": g.D2, "d2": g.d2, "R1": g.R1, "r1": g.r1, "R2": g.R2, "r4": g.r4,
            "L1": g.L1, "L2": g.L2, "L3": g.L3, "da": table.da, "dt": table.dt},
        "kind": kind,
        "numbers": numbers,
        "scope": if scope == Scope::All { "all" } else { "working" },
        "boxes": proof.map(|proof| proof.boxes.iter().map(box_of).collect::<Vec<_>>()),
        "complete": complete,
    })
}

/// The bounds of a proved posture, or null.
fn box_of(found: &Result<PostureBox, Unproved>) -> Value {
    match found {
        Ok(found) => json!({"pose": [found.x, found.y, found.z, found.alpha], "rho": found.rho}),
        Err(_) => Value::Null,
    }
}
