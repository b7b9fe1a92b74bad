//! Time of atlases, and their agreement with the solver at many points.
//!
//! `cargo bench -p verne-solver --bench atlas` prints the table as Markdown: for the built-in machines, machines with
//! equal offsets, and random machines. Numbers of solutions are compared at 100,000 random points of each window, and
//! areas with a lattice of 2,000² points. With the argument `near` it prints machines near the special ones instead.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a bench that cannot run must stop")]
#![allow(clippy::cast_precision_loss, reason = "counts are far below 2^53")]

#[path = "../../tests/atlas/comparison.rs"]
mod comparison;
#[path = "../../tests/support/lengths.rs"]
mod lengths;
#[path = "../../tests/support/machines.rs"]
mod machines;
#[path = "../../tests/support/random.rs"]
mod random;

use std::time::Instant;

use verne_solver::Machine;
use verne_solver::atlas::{AtlasRequest, Space, atlas};
use verne_solver::workspace::Unobserved;

use comparison::{compare_numbers, lattice_areas, region_areas};
use machines::{changed, spread};
use random::Random;

/// What is compared in a full run.
const POINTS: usize = 100_000;
const LATTICE: u32 = 2_000;
/// Random machines of a full run.
const MACHINES: usize = 10;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let part = if arguments.iter().any(|argument| argument == "--bench") { 1 } else { 100 };
    println!(
        "| machine | space | ms | curves | regions | compared | disagree | areas, greatest difference |"
    );
    println!("|---|---|---:|---:|---:|---:|---:|---:|");
    let machines = if arguments.iter().any(|argument| argument == "near") { near() } else { usual(part) };
    for (name, machine) in machines {
        for space in [Space::Platform, Space::Joints] {
            line(&name, &machine, space, part);
        }
    }
}

fn usual(part: usize) -> Vec<(String, Machine)> {
    let mut draw = Random::new(0xA71A);
    let equal = changed(|data| data.geometry.d2 = data.geometry.D2 - (data.geometry.D1 - data.geometry.d1));
    let built_in = [
        ("verne".into(), Machine::verne()),
        ("linear-delta, R1 = r1".into(), Machine::linear_delta()),
        ("verne, e1 = e2".into(), equal),
    ];
    let random = (0..MACHINES.div_ceil(part)).map(|i| {
        let machine =
            if i % 2 == 0 { draw.machine() } else { spread(&mut draw).unwrap_or_else(Machine::verne) };
        (format!("random {}", i + 1), machine)
    });
    built_in.into_iter().chain(random).collect()
}

/// Machines near those with R1 = r1, and near those with e1 = e2.
fn near() -> Vec<(String, Machine)> {
    let mut machines = Vec::new();
    for difference in [1e-12, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 9e-3] {
        let delta = changed(|data| data.geometry.R1 = data.geometry.r1 * (1.0 + difference));
        let equal = changed(|data| {
            let g = &mut data.geometry;
            (g.D1, g.d1, g.D2, g.d2) = (0.0, 512.0, 0.0, 512.0 + difference * 1024.0);
        });
        machines.push((format!("R1/r1 = 1 + {difference:e}"), delta));
        machines.push((format!("e1 - e2 = {difference:e} · 1024"), equal));
    }
    machines
}

fn line(name: &str, machine: &Machine, space: Space, part: usize) {
    let request = AtlasRequest::new(machine, space, None);
    let start = Instant::now();
    let found = atlas(machine, &request, &Unobserved);
    let ms = start.elapsed().as_secs_f64() * 1e3;
    match found {
        Err(error) => println!("| {name} | {space:?} | {ms:.0} | {error} |"),
        Ok(found) => {
            // The forward solution near the special machines takes some hundred times as long.
            let (points, lattice) =
                if name.contains(" = ") { (POINTS / 10, LATTICE / 20) } else { (POINTS, LATTICE) };
            let compared = compare_numbers(machine, &request, &found, points / part);
            let lattice = lattice / u32::try_from(part.isqrt()).unwrap();
            let (expected, areas) = (lattice_areas(machine, &request, lattice), region_areas(&found));
            let whole: f64 = areas.iter().sum();
            let off = areas.iter().zip(expected).map(|(a, b)| (a - b).abs() / whole).fold(0.0, f64::max);
            let (curves, regions) = (found.curves.len(), found.regions.len());
            let (all, wrong) = (compared.compared, compared.wrong.len());
            println!("| {name} | {space:?} | {ms:.0} | {curves} | {regions} | {all} | {wrong} | {off:.1e} |");
        }
    }
}
