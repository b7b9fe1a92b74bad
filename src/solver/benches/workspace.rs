//! The workspace against a voxel sweep of 256³ points, as ratios in the same run.
//!
//! `cargo bench -p verne-solver --bench workspace` prints the table as Markdown; `-- rounds=N` sets
//! the number of interleaved rounds. Run as a test it times one round of a coarse sweep.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a bench that cannot be prepared has to stop")]
#![allow(clippy::cast_precision_loss, reason = "counts are far below 2^53")]

use std::hint::black_box;
use std::time::Instant;

use fast_surface_nets::ndshape::{RuntimeShape, Shape};
use fast_surface_nets::{SurfaceNetsBuffer, surface_nets};
use rayon::{ThreadPool, ThreadPoolBuilder};
use verne_solver::workspace::{Kind, Request, Unobserved, Volume, contains, measure, surface};
use verne_solver::{Machine, Margins, platform_working};

const LOW: [f64; 3] = [-420.0, -560.0, 850.0];
const HIGH: [f64; 3] = [410.0, 560.0, 1_650.0];

fn request(tolerance: f64) -> Request {
    Request {
        kind: Kind::Platform,
        tool_length: 0.0,
        phi1: 0.0,
        phi2: 0.0,
        table_clearance: None,
        tool_radius: 0.0,
        tolerance,
    }
}

fn member(machine: &Machine, point: [f64; 3]) -> bool {
    platform_working(machine, point).is_ok_and(|posture| Margins::of(machine, &posture, None).feasible())
}

/// The sweep: a sign for every point, and how many are inside.
fn sweep(machine: &Machine, n: u32) -> (Vec<f32>, f64) {
    let step = [0, 1, 2].map(|i| (HIGH[i] - LOW[i]) / f64::from(n - 1));
    let mut signs = Vec::with_capacity((n * n * n) as usize);
    let mut count = 0.0;
    for k in 0..n {
        for j in 0..n {
            for i in 0..n {
                let at = |axis: usize, number: u32| LOW[axis] + f64::from(number) * step[axis];
                let inside = member(machine, [at(0, i), at(1, j), at(2, k)]);
                count += f64::from(u8::from(inside));
                signs.push(if inside { -1.0 } else { 1.0 });
            }
        }
    }
    (signs, count * step[0] * step[1] * step[2])
}

fn nets(signs: &[f32], n: u32) -> usize {
    let shape = RuntimeShape::<u32, 3>::new([n; 3]);
    assert_eq!(shape.size() as usize, signs.len());
    let mut buffer = SurfaceNetsBuffer::default();
    surface_nets(signs, &shape, [0; 3], [n - 1; 3], &mut buffer);
    buffer.indices.len() / 3
}

fn timed<T>(run: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let answer = black_box(run());
    (answer, start.elapsed().as_secs_f64() * 1e3)
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Bytes of a mesh as it is returned.
fn bytes(positions: usize, triangles: usize) -> usize {
    positions * 24 + triangles * 16
}

fn pool(threads: usize) -> ThreadPool {
    ThreadPoolBuilder::new().num_threads(threads).build().unwrap()
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let full = arguments.iter().any(|argument| argument == "--bench");
    let wanted = arguments.iter().find_map(|argument| argument.strip_prefix("rounds=")?.parse().ok());
    let (rounds, n) = (wanted.unwrap_or(if full { 5 } else { 1 }), if full { 256 } else { 32 });
    let machine = black_box(Machine::verne());
    let (one, two) = (pool(1), pool(2));
    let fine = if full { 0.01 } else { 1.0 };
    let points: Vec<[f64; 3]> = (0_u32..)
        .map(|i| {
            let part = |ratio: f64| (f64::from(i) * ratio).fract();
            let parts = [part(0.819_172_5), part(0.671_043_6), part(0.549_700_5)];
            [0, 1, 2].map(|axis| LOW[axis] + parts[axis] * (HIGH[axis] - LOW[axis]))
        })
        .filter(|point| member(&machine, *point))
        .take(100_000)
        .collect();
    let names = [
        "sweep",
        "surface nets",
        "mesh, 1 mm",
        "volume",
        "mesh, fine, 1 thread",
        "mesh, fine, 2 threads",
        "1e5 IK solves",
        "1e5 members",
    ];
    let mut times = vec![Vec::new(); names.len()];
    let mut notes = Vec::new();
    for _ in 0..rounds {
        let ((signs, swept), time) = timed(|| sweep(&machine, n));
        times[0].push(time);
        let (triangles, time) = timed(|| nets(&signs, n));
        times[1].push(time);
        let (mesh, time) = timed(|| one.install(|| surface(&machine, &request(1.0), &Unobserved).unwrap()));
        times[2].push(time);
        let (answer, time) = timed(|| one.install(|| measure(&machine, &request(1.0), &Unobserved).unwrap()));
        times[3].push(time);
        let (fine_mesh, time) =
            timed(|| one.install(|| surface(&machine, &request(fine), &Unobserved).unwrap()));
        times[4].push(time);
        times[5].push(timed(|| two.install(|| surface(&machine, &request(fine), &Unobserved).unwrap())).1);
        let solve = |point: &[f64; 3]| platform_working(&machine, *point).is_ok();
        times[6].push(timed(|| points.iter().filter(|point| black_box(solve(point))).count()).1);
        times[7].push(
            timed(|| one.install(|| contains(&machine, &request(1.0), &points, &Unobserved).unwrap())).1,
        );
        let Volume::Value { value, error } = answer.volume else { panic!("folded") };
        notes = vec![
            format!("sweep: volume off by {:.1e}, {} bytes of signs", swept / value - 1.0, signs.len() * 4),
            format!("surface nets: {triangles} triangles"),
            format!(
                "mesh, 1 mm: {} triangles, {} bytes, volume off by {:.1e}",
                mesh.triangles.len(),
                bytes(mesh.positions.len(), mesh.triangles.len()),
                mesh.volume() / value - 1.0
            ),
            format!("volume: error bound {:.1e}", error / value),
            format!(
                "mesh, {fine} mm: {} triangles, volume off by {:.1e}",
                fine_mesh.triangles.len(),
                fine_mesh.volume() / value - 1.0
            ),
        ];
    }
    let medians: Vec<f64> = times.iter_mut().map(|times| median(times)).collect();
    println!(
        "Medians of {rounds} interleaved rounds, {n}³ points.\n\n| | ms | sweep's time over it |\n|---|---:|---:|"
    );
    for (name, time) in names.iter().zip(&medians) {
        println!("| {name} | {time:.2} | {:.1} |", medians[0] / time);
    }
    // The cheapest predicate there can be: one solution a point, no margins, nothing refused.
    let least = medians[6] / 1e5 * f64::from(n).powi(3);
    println!(
        "\n- a sweep of one IK solve a point, {least:.0} ms, over the mesh: {:.0}, over the volume: {:.0}",
        least / medians[2],
        least / medians[3]
    );
    println!("- two threads over one: {:.2}", medians[4] / medians[5]);
    println!("- members over IK solves: {:.2}", medians[7] / medians[6]);
    for note in notes {
        println!("- {note}");
    }
}
