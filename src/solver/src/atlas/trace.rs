//! All arcs of an atlas.

use super::answer::{CurveKind, PointKind};
use super::arc::{Arc, Fineness};
use super::arc_node::ArcNode;
use super::chart::Chart;
use super::continuation::End;
use super::fold::Fold;
use super::leg_one::{Branch, Shape};
use super::path::Path;
use super::place::Configuration;
use super::rectangle::Rectangle;
use super::request::{AtlasError, Space};
use super::search::Search;
use super::target::{Bound, Bounds, System, Target};
use crate::interval::Interval;
use crate::workspace::Observer;

/// The part of the window's side by which boxes are searched beyond it, and by which curves are followed.
const BEYOND: [f64; 2] = [0.5, 1.5];

/// Most points on edges from which a family of curves is followed, and most points of its components.
const MOST_STARTS: usize = 20_000;
const MOST_POINTS: usize = 100_000;

/// One family of curves: which function, what it is called, which part of it matters.
struct Curves {
    target: Target,
    kind: Option<CurveKind>,
    bounds: Bounds,
}

/// The curves of a plane for a branch of leg I.
fn curves(shape: &Shape, space: Space) -> Vec<Curves> {
    match space {
        Space::Platform => platform_curves(shape.branch),
        Space::Joints => joint_curves(shape),
    }
}

fn of(target: Target, kind: Option<CurveKind>, bounds: &[Bound]) -> Curves {
    Curves { target, kind, bounds: Bounds::of(bounds) }
}

/// Where a rod of leg I is level, on the border of the working mode.
fn working_rods() -> [Curves; 2] {
    use Bound::{LegThree, LegTwo, RodEleven, RodTwelve, Uncrossed};
    [
        of(Target::RodEleven, None, &[LegTwo, LegThree, RodTwelve, Uncrossed]),
        of(Target::RodTwelve, None, &[LegTwo, LegThree, RodEleven, Uncrossed]),
    ]
}

fn platform_curves(branch: Branch) -> Vec<Curves> {
    use Bound::{LegOne, LegThree, LegTwo};
    let (second, third) = (Some(CurveKind::LegTwo), Some(CurveKind::LegThree));
    match branch {
        Branch::Only => {
            let rods = working_rods();
            let legs = [of(Target::LegTwo, second, &[LegThree]), of(Target::LegThree, third, &[LegTwo])];
            legs.into_iter().chain(rods).collect()
        }
        // The mirror image of a configuration is on the same branch: the half above suffices.
        Branch::Level | Branch::Crossed => vec![
            of(Target::LegTwo, second, &[LegThree, LegOne]),
            of(Target::LegThree, third, &[LegTwo, LegOne]),
        ],
    }
}

fn joint_curves(shape: &Shape) -> Vec<Curves> {
    use Bound::{LegOne, LegThree, LegTwo, RodEleven, RodTwelve, Uncrossed};
    let mut found = vec![of(Target::Parallel, Some(CurveKind::Parallel), &[])];
    match shape.branch {
        Branch::Only => {
            found.push(of(Target::LegTwo, None, &[LegThree, RodEleven, RodTwelve, Uncrossed]));
            found.push(of(Target::LegThree, None, &[LegTwo, RodEleven, RodTwelve, Uncrossed]));
            found.extend(working_rods());
        }
        Branch::Level => {
            found.push(of(Target::Constraint, Some(CurveKind::Constraint), &[]));
            found.push(of(Target::LegTwo, None, &[LegThree, LegOne]));
            found.push(of(Target::LegThree, None, &[LegTwo, LegOne]));
        }
        Branch::Crossed => {}
    }
    if shape.has_equal_offsets() {
        for curves in &mut found {
            curves.bounds = curves.bounds.with(Bound::MirrorSide);
        }
        found.push(of(Target::MirrorPlane, Some(CurveKind::Parallel), &[]));
    }
    found
}

/// The arcs of an atlas, cut at the window's sides, and the points that are no arcs.
pub(super) struct Traced<'a> {
    pub(super) arcs: Vec<Arc<'a>>,
    pub(super) points: Vec<(PointKind, [f64; 2])>,
}

/// Finds all arcs of a plane in a window. `tolerance` is in units of the longest dimension.
pub(super) fn traced<'a>(
    shapes: &'a [Shape],
    space: Space,
    window: &Rectangle,
    tolerance: f64,
    observer: &dyn Observer,
) -> Result<Traced<'a>, AtlasError> {
    let fineness = Fineness { tolerance, window: *window };
    let (mut arcs, mut points) = (Vec::new(), Vec::new());
    for shape in shapes {
        if let Some(chart) = Chart::new(shape) {
            for Curves { target, kind, bounds } in curves(shape, space) {
                let system = System { shape, space, target, bounds };
                let found = components(&system, chart, window, tolerance, observer)?;
                for (chain, closed, ends) in found {
                    let path = Path::Zeros(system);
                    let mut nodes = path.refined(&chain, &fineness);
                    mark_ends(&mut nodes, ends);
                    mark_tangencies(&system, &mut nodes);
                    arcs.push(Arc { kind, path, nodes, closed });
                }
            }
        }
    }
    if space == Space::Platform {
        add_folds(&shapes[0], &fineness, &mut arcs);
        points.extend(shapes.last().into_iter().flat_map(isolated).map(|at| (PointKind::Isolated, at)));
    }
    let (mut drawn, rest): (Vec<_>, Vec<_>) = arcs.into_iter().partition(|arc| !is_a_point(arc));
    points.extend(rest.iter().map(|arc| (PointKind::SelfMotion, arc.nodes[0].at)));
    points.retain(|(_, at)| window.contains(*at));
    drawn = drawn.into_iter().flat_map(|arc| arc.clipped(window)).collect();
    Ok(Traced { arcs: drawn, points })
}

/// A chain of configurations, whether it is closed, and how its ends came about.
type Chain = (Vec<Configuration>, bool, [End; 2]);

/// The components of a curve in the window.
fn components(
    system: &System<'_>,
    chart: Chart,
    window: &Rectangle,
    tolerance: f64,
    observer: &dyn Observer,
) -> Result<Vec<Chain>, AtlasError> {
    let beyond = BEYOND.map(|part| window.with_margin(part * window.side()));
    let mirrors = system.space == Space::Joints;
    // A mirror image has the other sides.
    let above = |bound: Bound| !mirrors && system.bounds.contains(bound);
    let is_symmetric = window.low == window.high.map(|high| -high);
    let windows =
        if mirrors && !is_symmetric { vec![beyond[0], beyond[0].mirrored()] } else { vec![beyond[0]] };
    let mut starts = Vec::new();
    for (i, rectangle) in windows.iter().enumerate() {
        let search = Search {
            system: *system,
            chart,
            window: [0, 1].map(|i| Interval::new(rectangle.low[i], rectangle.high[i])),
            tolerance,
            above_only: [above(Bound::LegTwo), above(Bound::LegThree)],
        };
        let found = search.points(observer)?;
        if i == 0 {
            starts.extend(found.iter().copied());
        }
        if i + 1 == windows.len() {
            starts.extend(found.iter().map(|q| system.mirrored(q)));
        }
    }
    let mut chains: Vec<Chain> = Vec::new();
    let mut points = 0;
    for (number, start) in starts.into_iter().enumerate() {
        if number > MOST_STARTS || points > MOST_POINTS {
            return Err(AtlasError::TooFine { near: None });
        }
        if observer.cancelled() {
            return Err(AtlasError::Cancelled);
        }
        if system.reserve(&start) < 0.0 || !beyond[1].contains(system.image(&start)) {
            continue;
        }
        let is_known = chains
            .iter()
            .any(|(chain, _, _)| chain.windows(2).any(|pair| system.contains([&pair[0], &pair[1]], &start)));
        if !is_known {
            let chain = component(system, &start, &beyond[1]);
            points += chain.0.len();
            chains.push(chain);
        }
    }
    Ok(chains)
}

/// The component through a point, as far as the rectangle reaches.
fn component(system: &System<'_>, start: &Configuration, rectangle: &Rectangle) -> Chain {
    let wants = |q: &Configuration| rectangle.contains(system.image(q));
    let (forth, end) = system.walk(start, 1.0, wants);
    let mut chain = vec![*start];
    if end == End::Start {
        chain.extend(forth);
        if let Some(last) = system.closing(chain[chain.len() - 1], start) {
            chain.push(last);
        }
        return (chain, true, [End::Start; 2]);
    }
    let (back, start_end) = system.walk(start, -1.0, wants);
    let mut whole: Vec<Configuration> = back.into_iter().rev().collect();
    whole.append(&mut chain);
    whole.extend(forth);
    (whole, false, [start_end, end])
}

fn mark_ends(nodes: &mut [ArcNode], [start, end]: [End; 2]) {
    if start == End::Bound
        && let Some(first) = nodes.first_mut()
    {
        first.mark = Some(PointKind::Corner);
    }
    if end == End::Bound
        && let Some(last) = nodes.last_mut()
    {
        last.mark = Some(PointKind::Corner);
    }
}

/// Inserts the points at which the curve touches that on which the plane is covered anew: leg I's fold, or the curve
/// of `det_P`.
fn mark_tangencies(system: &System<'_>, nodes: &mut Vec<ArcNode>) {
    if system.target.is_critical() || system.target == Target::Constraint {
        return;
    }
    let critical = System { target: Target::Parallel, ..*system };
    let fold = |q: &Configuration| match system.space {
        Space::Platform => system.shape.place(q).leg_one_fold(),
        // The factor that is left out for e1 = e2 is zero at the ends of curves only.
        Space::Joints => critical.linearised(q).0[3],
    };
    let path = Path::Zeros(*system);
    let mut i = 0;
    while i + 1 < nodes.len() {
        let [a, b] = [nodes[i], nodes[i + 1]];
        let product = fold(&a.q) * fold(&b.q);
        if product < 0.0
            && let Some(q) = system.zero_between([&a.q, &b.q], fold)
        {
            nodes.insert(i + 1, ArcNode { mark: Some(PointKind::Tangency), ..path.node(q) });
            i += 1;
        }
        i += 1;
    }
}

/// Adds leg I's fold where both other legs reach.
fn add_folds<'a>(shape: &'a Shape, fineness: &Fineness, arcs: &mut Vec<Arc<'a>>) {
    const FIRST: u32 = 16;
    for fold in Fold::quarters(shape) {
        let path = Path::Fold(fold);
        for [from, to] in fold.parts() {
            let at = |i: u32| fold.at(from + (to - from) * f64::from(i) / f64::from(FIRST));
            let chain: Vec<_> = (0..=FIRST).map(at).collect();
            let mut nodes = path.refined(&chain, fineness);
            if let Some(first) = nodes.first_mut() {
                first.mark = Some(if from == 0.0 { PointKind::Corner } else { PointKind::Tangency });
            }
            if to < std::f64::consts::FRAC_PI_2
                && let Some(last) = nodes.last_mut()
            {
                last.mark = Some(PointKind::Tangency);
            }
            arcs.push(Arc { kind: Some(CurveKind::LegOne), path, nodes, closed: false });
        }
    }
}

/// The places at a = π where leg I is level: four of its angles merge there and nowhere near.
fn isolated(shape: &Shape) -> impl Iterator<Item = [f64; 2]> {
    let square = shape.squares[0] - (shape.R1 + shape.r1).powi(2);
    let x = (square > 0.0).then(|| square.sqrt());
    x.into_iter().flat_map(|x| [x, -x]).filter_map(move |x1| {
        let phi = std::f64::consts::PI;
        let q = [x1, 0.0, phi, 0.0, 0.0];
        let reaches = shape.place(&q).height_squares().into_iter().all(|square| square > 0.0);
        reaches.then(|| shape.image(Space::Platform, &q))
    })
}

/// Whether an arc is one point of the plane.
fn is_a_point(arc: &Arc<'_>) -> bool {
    const SAME: f64 = 1e-9;
    let first = arc.nodes[0].at;
    arc.nodes.iter().all(|node| (node.at[0] - first[0]).abs() < SAME && (node.at[1] - first[1]).abs() < SAME)
}
