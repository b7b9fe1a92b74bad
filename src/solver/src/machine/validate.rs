//! The conditions that make plain numbers a machine.

use std::f64::consts::PI;

use super::{Geometry, Limits, MachineData, MachineFault};
use crate::axis::direction;
use crate::limit::MOST_RATIO;

/// Largest length accepted in a machine, mm.
const LARGEST: f64 = 1e6;
/// Least length that is accepted where a length must be positive, mm.
const SMALLEST: f64 = 1e-3;
/// How much longer than needed a leg must be at home, relative to what is needed.
const LONGER: f64 = 1e-6;
/// Least R1/r1 - 1, and least |e1 - e2| relative to the longest leg, at which the forward problem keeps its
/// solutions. With R1 = r1 the double root a = 0 of its polynomial represents a whole branch. With e1 = e2 two
/// mirror-image solutions share each root. Near these machines the solutions of the polynomial are too close together
/// for double precision.
const DISTINCT: f64 = 1e-3;
/// Least |`det_P`| at home.
pub(super) const LEAST_HOME_DET: f64 = 1e-9;

/// Finds all faults of the data. It examines the home posture only if the numbers themselves are valid.
pub(super) fn faults(data: &MachineData) -> Vec<MachineFault> {
    let mut faults = Faults(Vec::new());
    faults.check(!data.name.is_empty() && data.name.len() <= 64, "name", "must have 1 to 64 characters");
    geometry(&data.geometry, &mut faults);
    for (field, value) in [("table/da", data.table.da), ("table/dt", data.table.dt)] {
        faults.number(field, value);
    }
    limits(&data.limits, &mut faults);
    if faults.0.is_empty() {
        proportions(data, &mut faults);
        elimination(&data.geometry, &mut faults);
        home(&data.geometry, &mut faults);
    }
    faults.0
}

/// The longest dimension that occurs in the equations.
pub(super) fn longest(g: &Geometry) -> f64 {
    let (e1, e2) = (g.D1 - g.d1, g.D2 - g.d2);
    [g.L1, g.L2, g.L3, g.R1, g.r1, g.R2, g.r4, e1.abs(), e2.abs()].into_iter().fold(0.0, f64::max)
}

/// The table's offsets. They rotate with the platform, like lengths in requests.
fn proportions(data: &MachineData, faults: &mut Faults) {
    let most = MOST_RATIO * longest(&data.geometry);
    for (field, value) in [("table/da", data.table.da), ("table/dt", data.table.dt)] {
        faults.check(
            value.abs() <= most,
            field,
            &format!(
                "must be within ±{most} mm: {MOST_RATIO:e} times the longest dimension of legs and platform. \
                 Beyond that double precision loses solutions"
            ),
        );
    }
}

struct Faults(Vec<MachineFault>);

impl Faults {
    fn check(&mut self, holds: bool, field: &str, detail: &str) {
        if !holds {
            self.0.push(MachineFault::new(field, detail));
        }
    }

    fn number(&mut self, field: &str, value: f64) {
        self.check(value.abs() <= LARGEST, field, "must be a finite number between -1e6 and 1e6 mm");
    }

    fn length(&mut self, field: &str, value: f64) {
        self.check(
            (SMALLEST..=LARGEST).contains(&value),
            field,
            "must be a positive length between 1e-3 and 1e6 mm",
        );
    }

    fn range(&mut self, field: &str, [low, high]: [f64; 2], largest: f64, unit: &str) {
        let holds = low.abs() <= largest && high.abs() <= largest && low < high;
        self.check(
            holds,
            field,
            &format!("must be [min, max] with min < max, both within ±{largest} {unit}"),
        );
    }
}

fn geometry(g: &Geometry, faults: &mut Faults) {
    for (field, value) in [("D1", g.D1), ("d1", g.d1), ("D2", g.D2), ("d2", g.d2)] {
        faults.number(&format!("geometry/{field}"), value);
    }
    let lengths = [
        ("R1", g.R1),
        ("r1", g.r1),
        ("R2", g.R2),
        ("r4", g.r4),
        ("L1", g.L1),
        ("L2", g.L2),
        ("L3", g.L3),
        ("parallelogram_half_width", g.parallelogram_half_width),
    ];
    for (field, value) in lengths {
        faults.length(&format!("geometry/{field}"), value);
    }
    let radius = (0.0..=LARGEST).contains(&g.rod_radius);
    faults.check(radius, "geometry/rod_radius", "must be a length between 0 and 1e6 mm");
}

fn limits(l: &Limits, faults: &mut Faults) {
    for (i, &stroke) in l.stroke.iter().enumerate() {
        faults.range(&format!("limits/stroke/{i}"), stroke, LARGEST, "mm");
    }
    for (field, cone) in [("slider_cone", l.slider_cone), ("platform_cone", l.platform_cone)] {
        let holds = cone > 0.0 && cone <= PI;
        faults.check(holds, &format!("limits/{field}"), "must be a half-angle above 0 and up to 180 degrees");
    }
    for (field, margin) in [("serial_margin", l.serial_margin), ("parallel_margin", l.parallel_margin)] {
        let holds = (0.0..1.0).contains(&margin);
        faults.check(holds, &format!("limits/{field}"), "must be at least 0 and below 1");
    }
    for (field, range) in [("tilt", l.tilt), ("rotary", l.rotary)] {
        let degrees = range.map(f64::to_degrees);
        faults.range(&format!("limits/{field}"), degrees, 36_000.0, "degrees");
    }
    let clearance = l.table_clearance.is_none_or(|least| (0.0..=LARGEST).contains(&least));
    faults.check(clearance, "limits/table_clearance", "must be a length between 0 and 1e6 mm");
    for (field, axes) in [("slider_axes", l.slider_axes), ("platform_axes", l.platform_axes)] {
        for (i, axis) in axes.iter().flatten().enumerate() {
            faults.check(
                direction(*axis).is_some(),
                &format!("limits/{field}/{i}"),
                "must be a direction: three finite numbers, not all zero",
            );
        }
    }
}

/// The forward problem must keep all of its solutions: see [`DISTINCT`].
fn elimination(g: &Geometry, faults: &mut Faults) {
    let offset = ((g.D1 - g.d1) - (g.D2 - g.d2)).abs();
    let needed = DISTINCT * g.L1.max(g.L2).max(g.L3);
    faults.check(
        offset >= needed,
        "geometry/D1",
        &format!(
            "D1 - d1 and D2 - d2 must differ by at least {DISTINCT:e} of the longest leg, here {needed:.6} mm; they \
             differ by {offset:.6} mm. With equal offsets the sliders determine x up to its mirror image about \
             x = d1 - D1 only. This version does not solve that case, and it loses forward solutions close to it"
        ),
    );
    if g.R1 <= g.r1 {
        let detail = "must be greater than r1: otherwise the rods of leg I are parallel or crossed at home";
        faults.check(false, "geometry/R1", detail);
        return;
    }
    let needed = DISTINCT * g.r1;
    faults.check(
        g.R1 - g.r1 >= needed,
        "geometry/R1",
        &format!(
            "must exceed r1 by at least {DISTINCT:e} of r1, here {needed:.6} mm; it exceeds r1 by {:.6} mm. With R1 = r1 \
             the rods of leg I stay parallel and the platform does not turn (a linear delta). This version does not \
             solve that case, and it loses forward solutions close to it",
            g.R1 - g.r1
        ),
    );
}

/// At x = y = alpha = 0 every leg must reach the platform from above.
fn home(g: &Geometry, faults: &mut Faults) {
    let legs = [
        ("geometry/L1", g.L1, g.D1 - g.d1, g.R1 - g.r1),
        ("geometry/L2", g.L2, g.D2 - g.d2, g.R2 - g.r4),
        ("geometry/L3", g.L3, g.D2 - g.d2, g.R2 - g.r4),
    ];
    for (field, length, x, y) in legs {
        let needed = x.hypot(y);
        faults.check(
            length > needed * (1.0 + LONGER),
            field,
            &format!("must be longer than {needed:.6} mm, or there is no home pose at x = y = alpha = 0"),
        );
    }
}
