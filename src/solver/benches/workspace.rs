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
    Request::new(Kind::Platform, tolerance)
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

/// Points of the workspace, spread evenly.
fn members(machine: &Machine) -> Vec<[f64; 3]> {
    (0_u32..)
        .map(|i| {
            let fraction = |ratio: f64| (f64::from(i) * ratio).fract();
            let fractions = [fraction(0.819_172_5), fraction(0.671_043_6), fraction(0.549_700_5)];
            [0, 1, 2].map(|axis| LOW[axis] + fractions[axis] * (HIGH[axis] - LOW[axis]))
        })
        .filter(|point| member(machine, *point))
        .take(100_000)
        .collect()
}

const NAMES: [&str; 8] = [
    "sweep",
    "surface nets",
    "mesh, 1 mm",
    "volume",
    "mesh, fine, 1 thread",
    "mesh, fine, 2 threads",
    "1e5 IK solves",
    "1e5 members",
];

struct Bench {
    machine: Machine,
    /// Points of the sweep along each axis, and the tolerance of the fine mesh.
    n: u32,
    fine: f64,
    points: Vec<[f64; 3]>,
    one: ThreadPool,
    two: ThreadPool,
}

impl Bench {
    /// The times of one round, in the order of [`NAMES`], and notes on the results.
    fn round(&self) -> (Vec<f64>, Vec<String>) {
        let Self { machine, n, fine, points, one, two } = self;
        let mesh_within = |pool: &ThreadPool, tolerance: f64| {
            timed(|| pool.install(|| surface(machine, &request(tolerance), &Unobserved).unwrap()))
        };
        let ((signs, swept), sweep_time) = timed(|| sweep(machine, *n));
        let (triangles, nets_time) = timed(|| nets(&signs, *n));
        let (mesh, mesh_time) = mesh_within(one, 1.0);
        let (answer, volume_time) =
            timed(|| one.install(|| measure(machine, &request(1.0), &Unobserved).unwrap()));
        let (fine_mesh, fine_time) = mesh_within(one, *fine);
        let (_, fine_time_of_two) = mesh_within(two, *fine);
        let solve = |point: &[f64; 3]| platform_working(machine, *point).is_ok();
        let (_, solve_time) = timed(|| points.iter().filter(|point| black_box(solve(point))).count());
        let (_, member_time) =
            timed(|| one.install(|| contains(machine, &request(1.0), points, &Unobserved).unwrap()));
        let Volume::Value { value, error } = answer.volume else { panic!("folded") };
        let notes = vec![
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
        let sweeps = [sweep_time, nets_time];
        let meshes = [mesh_time, volume_time, fine_time, fine_time_of_two];
        let times = [&sweeps[..], &meshes, &[solve_time, member_time]].concat();
        (times, notes)
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let full = arguments.iter().any(|argument| argument == "--bench");
    let wanted = arguments.iter().find_map(|argument| argument.strip_prefix("rounds=")?.parse().ok());
    let (rounds, n, fine) =
        if full { (wanted.unwrap_or(5), 256, 0.01) } else { (wanted.unwrap_or(1), 32, 1.0) };
    let machine = black_box(Machine::verne());
    let points = members(&machine);
    let bench = Bench { machine, n, fine, points, one: pool(1), two: pool(2) };
    let (mut times, mut notes) = (vec![Vec::new(); NAMES.len()], Vec::new());
    for _ in 0..rounds {
        let (round, found) = bench.round();
        for (all, time) in times.iter_mut().zip(round) {
            all.push(time);
        }
        notes = found;
    }
    let medians: Vec<f64> = times.iter_mut().map(|times| median(times)).collect();
    print(rounds, n, &medians, &notes);
}

fn print(rounds: usize, n: u32, medians: &[f64], notes: &[String]) {
    println!(
        "Medians of {rounds} interleaved rounds, {n}³ points.\n\n| | ms | sweep's time over it |\n|---|---:|---:|"
    );
    for (name, time) in NAMES.iter().zip(medians) {
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
