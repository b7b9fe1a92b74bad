//! Coarse workspaces, slices and dexterity maps of arbitrary machines.

use std::sync::atomic::{AtomicU32, Ordering};

use verne_solver::workspace::dexterity::{DexterityRequest, dexterity};
use verne_solver::workspace::{Kind, Observer, Request, WorkspaceError, measure, slice, surface};
use verne_solver::{MAX_INPUT, Machine};

use crate::draw::Draw;
use crate::lengths::scale;
use crate::machines::machine;
use crate::solver::clearance;

/// After so many calls of the observer a computation is cancelled, as a job would be.
const LOOKS: u32 = 2_000;

struct Impatient(AtomicU32);

impl Observer for Impatient {
    fn progress(&self, part: f64) {
        assert!((0.0..=1.0).contains(&part), "{part}");
    }

    fn cancelled(&self) -> bool {
        self.0.fetch_add(1, Ordering::Relaxed) >= LOOKS
    }
}

/// One computation.
pub(crate) fn workspaces(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let Some(machine) = machine(&mut draw) else { return };
    let unit = scale(&machine);
    let tool_length = draw.number(0.2 * unit);
    let [phi1, phi2] = [0; 2].map(|_| draw.number(2.0));
    let tolerance = if draw.one_in(8) { draw.number(unit) } else { unit * draw.between(0.01, 0.3) };
    let kind = draw.pick(&[Kind::Platform, Kind::Tool, Kind::Part]);
    let (table_clearance, tool_radius) = clearance(&machine, &mut draw);
    let request = Request { kind, tool_length, phi1, phi2, table_clearance, tool_radius, tolerance };
    let good = [tool_length, phi1, phi2, table_clearance.unwrap_or_default(), tool_radius, tolerance]
        .iter()
        .all(|n| n.abs() <= MAX_INPUT)
        && tolerance >= 1e-3;
    let observer = Impatient(AtomicU32::new(0));
    match draw.below(8) {
        0..3 => volume(&machine, &request, good, &observer),
        3..5 => mesh(&machine, &request, good, &observer),
        5..7 => cut(&machine, &request, &mut draw, &observer),
        _ => map(&machine, &request, &mut draw, &observer),
    }
}

fn refused(error: WorkspaceError, good: bool) {
    assert_eq!(matches!(error, WorkspaceError::OutOfDomain { .. }), !good, "{error}");
}

fn finite(numbers: &[f64]) {
    assert!(numbers.iter().all(|n| n.is_finite()), "{numbers:?}");
}

fn volume(machine: &Machine, request: &Request, good: bool, observer: &Impatient) {
    match measure(machine, request, observer) {
        Ok(measure) => {
            if let verne_solver::workspace::Volume::Value { value, error } = measure.volume {
                assert!(value >= 0.0 && error >= 0.0, "{measure:?}");
                finite(&[value, error]);
            }
            assert!(measure.area >= 0.0 && measure.area_error >= 0.0, "{measure:?}");
            finite(&[measure.area, measure.area_error]);
            measure.jacobian.iter().for_each(|ends| finite(ends));
            finite(measure.inclination.as_slice());
        }
        Err(error) => refused(error, good),
    }
}

fn mesh(machine: &Machine, request: &Request, good: bool, observer: &Impatient) {
    match surface(machine, request, observer) {
        Ok(surface) => {
            surface.positions.iter().for_each(|position| finite(position));
            let count = surface.positions.len();
            assert!(surface.triangles.as_flattened().iter().all(|&corner| (corner as usize) < count));
            assert_eq!(surface.triangles.len(), surface.bindings.len());
            finite(&[surface.volume()]);
        }
        Err(error) => refused(error, good),
    }
}

fn cut(machine: &Machine, request: &Request, draw: &mut Draw<'_>, observer: &Impatient) {
    let height = draw.number(scale(machine));
    let alphas = [0; 2].map(|_| draw.number(1.0));
    let count = draw.below(3);
    if let Ok(slice) = slice(machine, request, height, &alphas[..count], observer) {
        finite(&[slice.area()]);
        for polygon in &slice.polygons {
            polygon.outer.iter().chain(polygon.holes.iter().flatten()).for_each(|point| finite(point));
        }
        for contour in &slice.contours {
            contour.points.iter().for_each(|point| finite(point));
        }
    }
}

fn map(machine: &Machine, request: &Request, draw: &mut Draw<'_>, observer: &Impatient) {
    let &Request { tool_length, phi1, phi2, table_clearance, tool_radius, .. } = request;
    let to = phi1 + draw.between(0.0, 6.2);
    let cell =
        if draw.one_in(4) { draw.number(scale(machine)) } else { scale(machine) * draw.between(0.2, 0.5) };
    let request =
        DexterityRequest { tool_length, table_clearance, tool_radius, phi2, phi1: [phi1, to], cell };
    if let Ok(map) = dexterity(machine, &request, observer) {
        assert_eq!(map.offsets.len(), map.grid.nodes() + 1);
        map.intervals.iter().for_each(|ends| assert!(phi1 <= ends[0] && ends[0] <= ends[1] && ends[1] <= to));
    }
}
