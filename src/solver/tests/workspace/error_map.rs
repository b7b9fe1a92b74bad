//! Error maps compared with membership, with error budgets, and with laws of the machine.

use verne_solver::error_budget::{ErrorBudget, Tolerances};
use verne_solver::parameter::{Parameter, ParameterUnit, ToolFrame};
use verne_solver::workspace::dexterity::Grid;
use verne_solver::workspace::error_map::{
    ErrorKind, ErrorMapRequest, NodeErrors, PointErrors, error_grid, error_slab, errors_at, largest,
    surface_errors,
};
use verne_solver::workspace::{Kind, Request, Unobserved, WorkspaceError, contains};
use verne_solver::{Machine, PartPose, Point, TableAngles, part_working};

use crate::machines::{changed, others};
use crate::observer::stops_at_calls;
use crate::random::Random;

fn tolerances() -> Tolerances {
    let each = Parameter::ALL.map(|parameter| {
        (parameter, if parameter.unit() == ParameterUnit::Millimetre { 0.01 } else { 5e-5 })
    });
    Tolerances::new(each).unwrap()
}

fn asked(kind: Kind, cell: f64) -> ErrorMapRequest {
    let workspace =
        Request { tool_length: 100.0, phi1: 0.2, phi2: 0.7, tool_radius: 5.0, ..Request::new(kind, 10.0) };
    ErrorMapRequest { workspace, tolerances: tolerances(), cell }
}

fn computed(machine: &Machine, request: &ErrorMapRequest) -> (Grid, Vec<NodeErrors>) {
    let grid = error_grid(machine, request, &Unobserved).unwrap();
    let nodes = error_slab(machine, request, &grid, 0..grid.counts[0], &Unobserved).unwrap();
    (grid, nodes)
}

fn position(grid: &Grid, node: u32) -> Point {
    let [_, across, up] = grid.counts;
    grid.node([node / up / across, node / up % across, node % up])
}

#[test]
fn nodes_with_errors_are_the_members_of_the_workspace() {
    let machines = std::iter::once(Machine::verne()).chain(others().into_iter().map(|(_, m)| m).take(3));
    for machine in machines {
        for kind in [Kind::Platform, Kind::Tool, Kind::Part] {
            let request = asked(kind, 120.0);
            let (grid, nodes) = computed(&machine, &request);
            let count = u32::try_from(grid.nodes()).unwrap();
            let points: Vec<Point> = (0..count).map(|node| position(&grid, node)).collect();
            let members = contains(&machine, &request.workspace, &points, &Unobserved).unwrap();
            let found: Vec<u32> = nodes.iter().map(|node| node.node).collect();
            for (node, member) in (0..count).zip(members) {
                let near = member.margin.is_some_and(|margin| margin.value.abs() < 1e-6);
                assert!(near || found.binary_search(&node).is_ok() == member.inside, "{kind:?} {node}");
                let n = points[node as usize];
                let outermost = (0..3).any(|axis| {
                    let steps = (n[axis] - grid.origin[axis]) / grid.step;
                    steps < 0.5 || steps > f64::from(grid.counts[axis]) - 1.5
                });
                assert!(!(outermost && member.inside), "the grid covers the workspace");
            }
            assert!(!found.is_empty() || kind == Kind::Part, "{kind:?}");
        }
    }
}

#[test]
fn in_the_base_frame_errors_depend_on_x_and_y_alone() {
    for kind in [Kind::Platform, Kind::Tool] {
        let (grid, nodes) = computed(&Machine::verne(), &asked(kind, 80.0));
        let mut compared = 0;
        for pair in nodes.windows(2) {
            let [a, b] = [0, 1].map(|i| position(&grid, pair[i].node));
            if a[..2] == b[..2] {
                for kind in ErrorKind::ALL {
                    let [one, other] = [0, 1].map(|i: usize| pair[i].errors.of(kind));
                    assert!((one - other).abs() <= 1e-8 * one, "{one} {other}");
                }
                compared += 1;
            }
        }
        assert!(compared > 100, "{compared}");
    }
}

#[test]
fn errors_are_those_of_the_budget_of_the_posture() {
    let (machine, request) = (Machine::verne(), asked(Kind::Part, 100.0));
    let (grid, nodes) = computed(&machine, &request);
    let Request { tool_length, phi1, phi2, .. } = request.workspace;
    for NodeErrors { node, errors } in nodes {
        let [x, y, z] = position(&grid, node);
        let posture = part_working(&machine, &PartPose { x, y, z, phi1, phi2 }, tool_length).unwrap();
        let table = TableAngles { theta1: posture.pose.alpha - phi1, theta2: -phi2 };
        let frame = ToolFrame::Part(table);
        let budget = ErrorBudget::of(&machine, &posture, tool_length, frame, &request.tolerances).unwrap();
        let expected = [budget.tip.rms, budget.tip.worst, budget.axis.rms, budget.axis.worst];
        for (kind, expected) in ErrorKind::ALL.into_iter().zip(expected) {
            assert!((errors.of(kind) - expected).abs() < 1e-9 * expected);
        }
    }
}

#[test]
fn no_random_point_has_a_larger_error_than_the_largest() {
    let mut draw = Random::new(2150);
    for kind in [Kind::Tool, Kind::Part] {
        let (machine, request) = (Machine::verne(), asked(kind, 60.0));
        let (grid, nodes) = computed(&machine, &request);
        let boundary = surface_errors(&machine, &request, usize::MAX, &Unobserved).unwrap();
        assert!(boundary.errors.iter().all(Option::is_some), "no singularity");
        let on_surface =
            boundary.surface.positions.iter().copied().zip(boundary.errors.iter().flatten().copied());
        let on_grid = nodes.iter().map(|found| (position(&grid, found.node), found.errors));
        let given: Vec<(Point, PointErrors)> = on_surface.chain(on_grid).collect();
        for error in ErrorKind::ALL {
            let most = largest(&machine, &request, error, &given, &Unobserved).unwrap().unwrap();
            assert!(given.iter().all(|(_, errors)| errors.of(error) <= most.value));
            let at = errors_at(&machine, &request, most.at).map_or(most.value, |errors| errors.of(error));
            assert!((at - most.value).abs() < 1e-9 * at, "it is attained");
            let mut inside = 0;
            for _ in 0..1_500 {
                let high = [0, 1, 2].map(|axis| grid.step * f64::from(grid.counts[axis]));
                let point = [0, 1, 2].map(|axis| grid.origin[axis] + draw.between(0.0, high[axis]));
                if let Some(errors) = errors_at(&machine, &request, point) {
                    inside += 1;
                    assert!(errors.of(error) <= most.value * (1.0 + 1e-3), "{error:?} {point:?}");
                }
            }
            assert!(inside > 100, "{inside}");
        }
    }
}

#[test]
fn the_length_of_the_tool_does_not_matter_to_the_platform() {
    let machine = Machine::verne();
    let longer = |length| {
        let mut request = asked(Kind::Platform, 100.0);
        request.workspace.tool_length = length;
        errors_at(&machine, &request, [10.0, 20.0, 1200.0]).unwrap()
    };
    assert_eq!(longer(0.0), longer(300.0));
}

#[test]
fn an_empty_workspace_has_an_empty_map() {
    // The two rods of a parallelogram touch everywhere.
    let machine = changed(|data| data.geometry.rod_radius = 300.0);
    let request = asked(Kind::Tool, 100.0);
    let (grid, nodes) = computed(&machine, &request);
    assert_eq!((grid.nodes(), nodes), (0, Vec::new()));
    assert_eq!(largest(&machine, &request, ErrorKind::TipRms, &[], &Unobserved), Ok(None));
}

#[test]
fn invalid_requests_are_refused_and_computations_stop() {
    let machine = Machine::verne();
    let fine = asked(Kind::Tool, 0.01);
    assert_eq!(error_grid(&machine, &fine, &Unobserved), Err(WorkspaceError::OutOfDomain { field: "cell" }));
    let many = asked(Kind::Tool, 0.2);
    let refused = error_grid(&machine, &many, &Unobserved);
    assert!(matches!(refused, Err(WorkspaceError::TooManyNodes { .. })));
    let request = asked(Kind::Tool, 150.0);
    let grid = error_grid(&machine, &request, &Unobserved).unwrap();
    let all = 0..grid.counts[0];
    stops_at_calls("error_grid", |observer| error_grid(&machine, &request, observer).map(drop));
    stops_at_calls("error_slab", |observer| {
        error_slab(&machine, &request, &grid, all.clone(), observer).map(drop)
    });
    stops_at_calls("surface_errors", |observer| {
        surface_errors(&machine, &request, usize::MAX, observer).map(drop)
    });
}
