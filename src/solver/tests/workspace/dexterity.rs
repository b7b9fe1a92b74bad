//! Grids, regions and volumes of dexterity, compared with membership, measure and each other.

use verne_solver::Machine;
use verne_solver::workspace::dexterity::{
    Dexterity, DexterityRequest, Grid, Region, dexterity, merge, orientations, slab, volumes,
};
use verne_solver::workspace::{
    Kind, Request, Surface, Unobserved, Volume, WorkspaceError, contains, measure,
};

use crate::machines::{changed, others};
use crate::observer::CallLimit;
use crate::topology::Topology;

fn asked(from: f64, to: f64, cell: f64) -> DexterityRequest {
    DexterityRequest { tool_length: 80.0, phi2: 0.3, ..DexterityRequest::new([from, to], cell) }
}

fn computed(machine: &Machine, request: &DexterityRequest) -> Dexterity {
    dexterity(machine, request, &Unobserved).unwrap()
}

fn value(volume: Volume) -> [f64; 2] {
    let Volume::Value { value, error } = volume else { panic!("folded") };
    [value, error]
}

/// The mesh as a surface, for the topology checks.
fn surface(region: &Region) -> Surface {
    let binding = verne_solver::workspace::Binding {
        constraint: verne_solver::Constraint::Stroke,
        element: verne_solver::Element::Platform,
    };
    Surface {
        positions: region.positions.clone(),
        triangles: region.triangles.clone(),
        bindings: vec![binding; region.triangles.len()],
    }
}

/// With a range of one inclination, both regions are the part's workspace for it.
#[test]
fn regions_for_one_inclination_are_the_part_workspace() {
    let mut machines = vec![changed(|data| data.limits.tilt = [-0.2, 0.6])];
    machines.extend(others().into_iter().map(|(_, machine)| machine).skip(3));
    let machines = machines.into_iter().flat_map(|machine| [(machine.clone(), None), (machine, Some(120.0))]);
    for (machine, table_clearance) in machines {
        let request = DexterityRequest { table_clearance, tool_radius: 40.0, ..asked(0.25, 0.25, 60.0) };
        let workspace = Request {
            kind: Kind::Part,
            tool_length: 80.0,
            phi1: 0.25,
            phi2: 0.3,
            table_clearance,
            tool_radius: 40.0,
            tolerance: 1.0,
        };
        let answer = measure(&machine, &workspace, &Unobserved).unwrap();
        let [exact, bound] = value(answer.volume);
        let found = computed(&machine, &request);
        for region in [&found.reachable, &found.dexterous] {
            let [volume, error] = value(region.volume);
            assert!((volume - exact).abs() <= error + bound, "{volume} ± {error}, {exact} ± {bound}");
            assert!(error < 2e-3 * exact, "{error} of {exact}");
        }
        let nodes = nodes(&found.grid);
        let members = contains(&machine, &workspace, &nodes, &Unobserved).unwrap();
        for (n, member) in members.iter().enumerate() {
            let [from, to] = [0, 1].map(|end| found.offsets[n + end] as usize);
            let near = member.margin.is_some_and(|margin| margin.value.abs() < 1e-6);
            assert!(near || (from < to) == member.inside, "{:?} {member:?}", nodes[n]);
        }
    }
}

fn nodes(grid: &Grid) -> Vec<[f64; 3]> {
    let [a, b, c] = grid.counts;
    let all = (0..a).flat_map(|i| (0..b).flat_map(move |j| (0..c).map(move |k| [i, j, k])));
    all.map(|number| grid.in_part_frame(grid.node(number))).collect()
}

#[test]
fn intervals_of_a_node_are_its_orientations() {
    let machine = Machine::verne();
    let request =
        DexterityRequest { table_clearance: Some(10.0), tool_radius: 30.0, ..asked(-1.2, 1.0, 70.0) };
    let found = computed(&machine, &request);
    let nodes = nodes(&found.grid);
    assert_eq!(found.offsets.len(), nodes.len() + 1);
    for (n, point) in nodes.iter().enumerate().step_by(7) {
        let alone = orientations(&machine, *point, &request).unwrap();
        let [from, to] = [0, 1].map(|end| found.offsets[n + end] as usize);
        let intervals = &found.intervals[from..to];
        assert_eq!(alone.len(), intervals.len(), "{point:?}");
        for (alone, interval) in alone.iter().zip(intervals) {
            assert!((0..2).all(|end| (alone.ends[end] - interval[end]).abs() < 1e-8));
        }
    }
}

/// A wider range makes the reachable region larger and the dexterous region smaller. The dexterous region lies in the
/// reachable one.
#[test]
fn a_wider_range_enlarges_the_reachable_and_shrinks_the_dexterous_region() {
    let machine = Machine::verne();
    let ranges = [[-0.1, 0.1], [-0.3, 0.3], [-0.6, 0.6]];
    let found = ranges.map(|[from, to]| volumes(&machine, &asked(from, to, 50.0), &Unobserved).unwrap());
    let sizes = found.map(|pair| pair.map(|volume| value(volume)[0]));
    assert!(sizes.iter().all(|[reachable, dexterous]| dexterous <= reachable), "{sizes:?}");
    assert!(sizes.windows(2).all(|pair| pair[0][0] < pair[1][0] && pair[0][1] > pair[1][1]), "{sizes:?}");
}

#[test]
fn surfaces_of_regions_are_closed_and_enclose_the_volume() {
    let short = changed(|data| data.limits.stroke = [[100.0, 400.0]; 3]);
    let above = |from, to, least, tool_length| DexterityRequest {
        table_clearance: Some(least),
        tool_radius: 60.0,
        tool_length,
        ..asked(from, to, 35.0)
    };
    for (machine, request) in [
        (Machine::verne(), asked(-0.2, 0.3, 50.0)),
        (short.clone(), asked(-0.2, 0.3, 50.0)),
        (Machine::verne(), above(-0.7, 0.4, 60.0, 80.0)),
        (Machine::verne(), above(0.3, 1.3, 0.0, 30.0)),
        (short, above(-0.4, 0.1, 400.0, 80.0)),
    ] {
        let found = computed(&machine, &request);
        for region in [&found.reachable, &found.dexterous] {
            let mesh = surface(region);
            let topology = Topology::of(&mesh);
            assert!(topology.is_manifold() && topology.components > 0, "{topology:?}");
            let [volume, _] = value(region.volume);
            assert!((mesh.volume() / volume - 1.0).abs() < 0.05, "{} {volume}", mesh.volume());
        }
    }
}

#[test]
fn a_map_does_not_depend_on_slabs_or_threads() {
    let machine = Machine::verne();
    let request = asked(-0.3, 0.4, 120.0);
    let whole = computed(&machine, &request);
    let grid = Grid::new(&machine, &request, &Unobserved).unwrap();
    let cuts = [0, 3, 4, grid.counts[0]];
    let mut slabs: Vec<_> = cuts
        .windows(2)
        .map(|ends| slab(&machine, &request, &grid, ends[0]..ends[1], &Unobserved).unwrap())
        .collect();
    slabs.rotate_left(1);
    let volumes = [whole.reachable.volume, whole.dexterous.volume];
    assert!(merge(&request, &grid, slabs.clone(), volumes, &Unobserved).unwrap() == whole);
    slabs.pop();
    assert_eq!(merge(&request, &grid, slabs, volumes, &Unobserved).unwrap_err(), WorkspaceError::Open);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert!(pool.install(|| computed(&machine, &request)) == whole);
}

#[test]
fn an_empty_map_has_no_nodes() {
    let machine = changed(|data| data.limits.rotary = Some([-0.1, 0.1]));
    let found = computed(&machine, &asked(-0.2, 0.2, 50.0));
    assert_eq!(found.grid.nodes(), 0);
    assert_eq!(found.offsets, [0]);
    assert_eq!(value(found.reachable.volume), [0.0; 2]);
    assert!(found.reachable.triangles.is_empty() && found.dexterous.positions.is_empty());
}

#[test]
fn a_grid_of_too_many_nodes_is_refused() {
    let machine = Machine::verne();
    let answer = Grid::new(&machine, &asked(-0.2, 0.2, 1.0), &Unobserved);
    assert!(matches!(answer, Err(WorkspaceError::TooManyNodes { nodes }) if nodes > 2e8), "{answer:?}");
    for (field, request) in [
        ("cell", asked(0.0, 0.1, 0.0)),
        ("phi1", asked(0.1, 0.0, 10.0)),
        ("phi1", asked(0.0, 7.0, 10.0)),
        ("phi2", DexterityRequest { phi2: f64::NAN, ..asked(0.0, 0.1, 10.0) }),
    ] {
        let answer = dexterity(&machine, &request, &Unobserved);
        assert_eq!(answer.unwrap_err(), WorkspaceError::OutOfDomain { field });
    }
}

/// The eleventh quarter of a turn divided by a quarter is less than eleven, in double precision.
#[test]
fn ranges_that_differ_by_whole_turns_have_the_same_grid() {
    let machine = changed(|data| data.limits.rotary = Some([-7.0, 7.0]));
    let [near, far] = [0.0, 3.0 * std::f64::consts::TAU].map(|turns| {
        let request = asked(turns - 1.9, turns - 1.2, 150.0);
        Grid::new(&machine, &request, &Unobserved).unwrap()
    });
    assert_eq!(near.counts, far.counts);
}

#[test]
fn a_map_calls_the_observer_at_every_node() {
    let machine = Machine::verne();
    let request = asked(-0.1, 0.1, 90.0);
    let calls = CallLimit::new(usize::MAX);
    let found = dexterity(&machine, &request, &calls).unwrap();
    assert!(calls.count() > found.grid.nodes());
}
