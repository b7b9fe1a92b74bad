//! The region of origins against plans at random origins.

use std::ops::Range;

use verne_solver::Machine;
use verne_solver::toolpath::{
    AdjustableProgram, OriginRegion, OriginRequest, OriginSlab, OriginSurvey, PlanOptions, SetUp,
    merge_origins, origin_slab, plan, slice_origins,
};
use verne_solver::workspace::Unobserved;

use super::placement::contour;
use super::random::Random;
use super::support::{Clamped, any_machine, arrive, feed};

const GIVEN: SetUp = SetUp { origin: [20.0, -30.0, 280.0], turn: 0.3, tool_length: 100.0 };
const PLACES: f64 = 0.02;
/// Distance from the boundary within which the places of a program decide otherwise than plans, mm.
const BAND: f64 = 0.05;

pub(crate) fn surveyed(machine: &Machine, program: &Clamped, cell: f64) -> OriginSurvey {
    let request = OriginRequest { cell, place_tolerance: PLACES };
    OriginSurvey::new(machine, program, GIVEN, &request, &PlanOptions::default(), None, &Unobserved).unwrap()
}

fn slab(machine: &Machine, survey: &OriginSurvey, layers: Range<u32>) -> OriginSlab {
    origin_slab(machine, survey, layers, &Unobserved).unwrap()
}

pub(crate) fn region(machine: &Machine, survey: &OriginSurvey) -> OriginRegion {
    let all = slab(machine, survey, 0..survey.grid.counts[0]);
    merge_origins(machine, survey, vec![all], &Unobserved).unwrap()
}

pub(crate) fn is_feasible(machine: &Machine, program: &Clamped, origin: [f64; 3]) -> bool {
    let motions = program.motions(&SetUp { origin, ..GIVEN });
    plan(machine, &*motions, &PlanOptions::default(), |_| true, |_| {}).unwrap().is_feasible()
}

/// A random origin in the box of the grid.
pub(crate) fn any_origin(survey: &OriginSurvey, random: &mut Random) -> [f64; 3] {
    let grid = &survey.grid;
    let last = grid.node(grid.counts.map(|count| count - 1));
    std::array::from_fn(|axis| random.between(grid.origin[axis], last[axis]))
}

/// Whether an origin is farther from the boundary than the tolerance, as far as some steps show.
fn is_clear(machine: &Machine, survey: &OriginSurvey, origin: [f64; 3]) -> bool {
    let inside = survey.contains(machine, origin);
    (0..6).all(|side| {
        let mut beside = origin;
        beside[side / 2] += if side % 2 == 0 { BAND } else { -BAND };
        survey.contains(machine, beside) == inside
    })
}

fn agrees_with_plans(machine: &Machine, program: &Clamped, origins: usize, random: &mut Random) {
    let survey = surveyed(machine, program, 50.0);
    assert!(survey.grid.nodes() > 0, "an origin is found");
    let (mut counts, mut others) = ([0; 2], Vec::new());
    for _ in 0..origins {
        let origin = any_origin(&survey, random);
        if is_clear(machine, &survey, origin) {
            let inside = survey.contains(machine, origin);
            counts[usize::from(inside)] += 1;
            if inside != is_feasible(machine, program, origin) {
                others.push((inside, origin));
            }
        }
    }
    assert!(others.is_empty(), "{} of {counts:?}: {others:?}", others.len());
    assert!(counts.iter().all(|count| *count > 0), "{counts:?}");
}

#[test]
fn the_region_agrees_with_plans_at_random_origins() {
    let mut random = Random::new(1901);
    agrees_with_plans(&Machine::verne(), &contour(), origins(300), &mut random);
    for _ in 0..3 {
        agrees_with_plans(&any_machine(&mut random), &contour(), origins(60), &mut random);
    }
}

/// The number of origins, or that of the environment variable ORIGINS.
pub(crate) fn origins(usual: usize) -> usize {
    std::env::var("ORIGINS").ok().and_then(|number| number.parse().ok()).unwrap_or(usual)
}

#[test]
fn a_long_program_is_limited_by_few_of_its_places() {
    let dome = |line: u32, point: u32| {
        let [x, y] = [f64::from(point) * 4.0 - 60.0, f64::from(line) * 4.0 - 60.0];
        ([x, y, -0.002 * (x * x + y * y)], [0.004 * x, 0.004 * y, 1.0])
    };
    let mut program = Vec::new();
    for line in 0..31 {
        for point in 0..31 {
            let (tip, axis) = dome(line, if line % 2 == 0 { point } else { 30 - point });
            program.push(if program.is_empty() { arrive(tip, axis) } else { feed(tip, axis) });
            let (tip, axis) = (tip.map(|c| c + 0.2), axis);
            program.push(feed(tip, axis));
        }
    }
    let (machine, program) = (Machine::verne(), Clamped(program));
    let survey = surveyed(&machine, &program, 50.0);
    let [all, limiting] = survey.place_counts();
    assert!(all > 1900 && limiting < all / 2, "{all} {limiting}");
    agrees_with_plans(&machine, &program, origins(100), &mut Random::new(1902));
}

#[test]
fn the_bytes_are_those_of_any_slabs_on_any_number_of_threads() {
    let machine = Machine::verne();
    let survey = surveyed(&machine, &contour(), 80.0);
    let whole = region(&machine, &survey);
    let layers = survey.grid.counts[0];
    let one = rayon_pool(1).install(|| {
        let survey = surveyed(&machine, &contour(), 80.0);
        let slabs = vec![
            slab(&machine, &survey, layers / 2..layers),
            slab(&machine, &survey, 0..2),
            slab(&machine, &survey, 2..layers / 2),
        ];
        merge_origins(&machine, &survey, slabs, &Unobserved).unwrap()
    });
    let bits = |region: &OriginRegion| -> Vec<[u64; 3]> {
        region.positions.iter().map(|at| at.map(f64::to_bits)).collect()
    };
    assert_eq!((bits(&whole), &whole.triangles), (bits(&one), &one.triangles));
    assert!(!whole.triangles.is_empty());
}

fn rayon_pool(threads: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap()
}

#[test]
fn the_volume_is_that_of_random_origins_and_slices_add_up_to_it() {
    let machine = Machine::verne();
    let survey = surveyed(&machine, &contour(), 30.0);
    let fine = region(&machine, &survey);
    let [volume, error] = [fine.volume(), fine.volume_error()];
    let mut random = Random::new(1903);
    let count = 20_000;
    let inside = (0..count).filter(|_| survey.contains(&machine, any_origin(&survey, &mut random))).count();
    let grid = &survey.grid;
    let last = grid.node(grid.counts.map(|count| count - 1));
    let all: f64 = (0..3).map(|axis| last[axis] - grid.origin[axis]).product();
    let part = inside as f64 / f64::from(count);
    let deviation = all * (part * (1.0 - part) / f64::from(count)).sqrt();
    assert!((volume - all * part).abs() < error + 4.0 * deviation, "{volume} {error} {}", all * part);
    assert!(error < 0.05 * volume, "{volume} {error}");
    // Slices of the surface in equal distances.
    let steps = 400;
    let height = (last[2] - grid.origin[2]) / f64::from(steps);
    let area = |step: u32| {
        let z = grid.origin[2] + height * (f64::from(step) + 0.5);
        let polygons = slice_origins(&fine.positions, &fine.triangles, z);
        let rings = polygons.iter().flat_map(|polygon| polygon.holes.iter().chain([&polygon.outer]));
        rings.map(|ring| area_of(ring)).sum::<f64>()
    };
    let sum = (0..steps).map(|step| height * area(step)).sum::<f64>();
    assert!((sum - fine.volume()).abs() < 1e-3 * sum, "{sum} {}", fine.volume());
}

fn area_of(ring: &[[f64; 2]]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|([ax, ay], [bx, by])| 0.5 * (ax * by - ay * bx)).sum()
}

#[test]
fn a_program_that_nothing_reaches_has_no_origins() {
    let program = Clamped(vec![arrive([0.0; 3], [0.0, 0.0, 1.0]), feed([3000.0, 0.0, 0.0], [0.0, 0.0, 1.0])]);
    let survey = surveyed(&Machine::verne(), &program, 50.0);
    assert_eq!(survey.grid.nodes(), 0);
    let region = region(&Machine::verne(), &survey);
    assert!(region.triangles.is_empty() && region.volume() == 0.0);
}
