//! Functions of many rows beside those of one row, by the registers that they use.

use std::hint::black_box;

use verne_solver::{
    Machine, Margins, PartPose, Point, Posture, PostureColumns, Registers, TableAngles, forward_working,
    forward_working_rows, margin_rows, part_working, part_working_rows, platform_working,
    platform_working_rows, tool_working, tool_working_rows, worst_margin_rows,
};

use crate::harness::{Candidate, measure};
use crate::inputs::{Inputs, TOOL};
use crate::report::missed;

/// The columns of the table.
const REGISTERS: [(&str, Registers); 3] =
    [("SSE2 or NEON", Registers::Baseline), ("AVX2", Registers::Avx2), ("widest", Registers::Widest)];

/// A function in both forms.
struct Comparison<'a> {
    name: &'static str,
    /// The factor that is wanted with AVX2.
    target: Option<f64>,
    /// The function of one row, then that of many rows by registers.
    candidates: Vec<Candidate<'a>>,
}

/// Times all functions in interleaved rounds and prints their table.
pub(crate) fn print(machine: &Machine, inputs: &Inputs, rounds: usize) {
    let rows: Vec<(Posture, Option<TableAngles>)> =
        inputs.tables.iter().map(|(posture, table)| (*posture, Some(*table))).collect();
    let parts = |rows: &[PartPose], registers| {
        part_working_rows(machine, rows, TOOL, registers, |_, answer| {
            black_box(&answer);
        });
    };
    let tools = |rows: &[Point], registers| {
        tool_working_rows(machine, rows, TOOL, registers, |_, answer| {
            black_box(&answer);
        });
    };
    let platforms = |rows: &[Point], registers| {
        platform_working_rows(machine, rows, registers, |_, answer| {
            black_box(&answer);
        });
    };
    let forward = |rows: &[[f64; 3]], registers| {
        forward_working_rows(machine, rows, registers, |_, answer| {
            black_box(&answer);
        });
    };
    let mut columns = PostureColumns::new();
    for (posture, table) in &rows {
        columns.push(posture, *table);
    }
    // The postures lie by coordinate, as the kernels of solutions leave them.
    let margins = |_: &[(Posture, Option<TableAngles>)], registers| {
        margin_rows(machine, black_box(&columns), None, registers, |_, margins| {
            black_box(margins);
        });
    };
    let worst = |rows: &[(Posture, Option<TableAngles>)], registers| {
        let mut columns = PostureColumns::new();
        for (posture, table) in rows {
            columns.push(posture, *table);
        }
        worst_margin_rows(machine, &columns, None, registers, |_, margin, feasible| {
            black_box((&margin, feasible));
        });
    };
    let mut comparisons = [
        compare(
            "IK part, working mode",
            Some(3.0),
            &inputs.parts,
            |row| part_working(machine, row, TOOL),
            &parts,
        ),
        compare(
            "IK tool, working mode",
            None,
            &inputs.tools,
            |&row| tool_working(machine, row, TOOL),
            &tools,
        ),
        compare(
            "IK platform, working mode",
            None,
            &inputs.points,
            |&row| platform_working(machine, row),
            &platforms,
        ),
        compare("FK, working mode", Some(2.5), &inputs.rho, |&row| forward_working(machine, row), &forward),
        compare(
            "margins of one pose, all",
            Some(3.0),
            &rows,
            |(row, table)| Margins::of(machine, row, *table),
            &margins,
        ),
        compare(
            "the worst margin and feasibility",
            None,
            &rows,
            |(row, table)| {
                let margins = Margins::of(machine, row, *table);
                (margins.worst(machine), margins.feasible())
            },
            &worst,
        ),
    ];
    for comparison in &mut comparisons {
        measure(&mut comparison.candidates, rounds);
    }
    println!(
        "\n| one thread, ns a row | one row | {} | {} | {} | target |",
        REGISTERS[0].0, REGISTERS[1].0, REGISTERS[2].0
    );
    println!("|---|---:|---:|---:|---:|---:|");
    comparisons.iter().for_each(print_row);
}

fn compare<'a, T, R>(
    name: &'static str,
    target: Option<f64>,
    inputs: &'a [T],
    one: impl Fn(&T) -> R + 'a,
    many: &'a (impl Fn(&[T], Registers) + 'a),
) -> Comparison<'a> {
    let mut candidates = vec![Candidate::new(name, inputs, one)];
    candidates.extend(REGISTERS.map(|(name, registers)| {
        Candidate::whole(name, inputs, move |inputs: &[T]| many(inputs, registers))
    }));
    Comparison { name, target, candidates }
}

fn print_row(comparison: &Comparison<'_>) {
    let [one, many @ ..] = &comparison.candidates[..] else { return };
    print!("| {} | {:.0} |", comparison.name, one.median());
    for candidate in many {
        print!(" {:.0} ({:.2} times) |", candidate.median(), one.ratio_to(candidate));
    }
    let with_avx2 = one.ratio_to(&many[1]);
    let target = comparison.target;
    println!(
        " {} |",
        target.map_or(String::new(), |least| format!("≥ {least}{}", missed(with_avx2 < least)))
    );
}
