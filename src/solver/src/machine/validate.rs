//! The conditions that make plain numbers a machine.

use std::f64::consts::PI;

use super::data::{Limits, MachineData};
use super::drives::{Drive, Drives};
use super::error::MachineError;
use crate::axis::direction;
use crate::mechanism::{Geometry, Mechanism};
use crate::request_range::MAX_LENGTH_RATIO;

/// Largest length accepted in a machine, mm.
const LARGEST: f64 = 1e6;
/// Least length that is accepted where a length must be positive, mm.
const SMALLEST: f64 = 1e-3;
/// Least velocity (mm/s, degrees/s) and acceleration (mm/s², degrees/s²) of a drive.
const LEAST_RATE: f64 = 1e-3;
/// How much longer than needed a leg must be at home, relative to what is needed.
const RELATIVE_LENGTH_RESERVE: f64 = 1e-6;
/// Least |`det_P`| at home.
pub(super) const LEAST_HOME_DET: f64 = 1e-9;

/// Finds all invalid fields. It examines the home posture only if the numbers themselves are valid.
pub(super) fn errors(data: &MachineData) -> Vec<MachineError> {
    let mut checker = Checker(Vec::new());
    checker.check(!data.name.is_empty() && data.name.len() <= 64, "name", "must have 1 to 64 characters");
    geometry(&data.geometry, &mut checker);
    for (field, value) in [("table/da", data.table.da), ("table/dt", data.table.dt)] {
        checker.number(field, value);
    }
    limits(&data.limits, &mut checker);
    if let Some(of_machine) = &data.drives {
        drives(of_machine, &mut checker);
    }
    if checker.0.is_empty() {
        proportions(data, &mut checker);
        leg_one(&data.geometry, &mut checker);
        home(&data.geometry, &mut checker);
    }
    checker.0
}

/// The table's offsets. They rotate with the platform, like lengths in requests.
fn proportions(data: &MachineData, checker: &mut Checker) {
    let most = MAX_LENGTH_RATIO * Mechanism::new(data.geometry).longest;
    for (field, value) in [("table/da", data.table.da), ("table/dt", data.table.dt)] {
        checker.check(
            value.abs() <= most,
            field,
            &format!(
                "must be within ±{most} mm: {MAX_LENGTH_RATIO:e} times the longest dimension of legs and platform. \
                 Beyond that double precision loses solutions"
            ),
        );
    }
}

struct Checker(Vec<MachineError>);

impl Checker {
    fn check(&mut self, holds: bool, field: &str, detail: &str) {
        if !holds {
            self.0.push(MachineError::new(field, detail));
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

fn geometry(g: &Geometry, checker: &mut Checker) {
    for (field, value) in [("D1", g.D1), ("d1", g.d1), ("D2", g.D2), ("d2", g.d2)] {
        checker.number(&format!("geometry/{field}"), value);
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
        checker.length(&format!("geometry/{field}"), value);
    }
    let turned = g.parallelogram_direction;
    checker.check(
        turned.abs() <= PI,
        "geometry/parallelogram_direction",
        "must be an angle between -180 and 180 degrees",
    );
    let radius = (0.0..=LARGEST).contains(&g.rod_radius);
    checker.check(radius, "geometry/rod_radius", "must be a length between 0 and 1e6 mm");
}

fn limits(l: &Limits, checker: &mut Checker) {
    for (i, &stroke) in l.stroke.iter().enumerate() {
        checker.range(&format!("limits/stroke/{i}"), stroke, LARGEST, "mm");
    }
    for (field, cone) in [("slider_cone", l.slider_cone), ("platform_cone", l.platform_cone)] {
        let holds = cone > 0.0 && cone <= PI;
        checker.check(
            holds,
            &format!("limits/{field}"),
            "must be a half-angle above 0 and up to 180 degrees",
        );
    }
    for (field, margin) in [("serial_margin", l.serial_margin), ("parallel_margin", l.parallel_margin)] {
        let holds = (0.0..1.0).contains(&margin);
        checker.check(holds, &format!("limits/{field}"), "must be at least 0 and below 1");
    }
    for (field, range) in [("tilt", Some(l.tilt)), ("rotary", l.rotary)] {
        if let Some(range) = range {
            checker.range(&format!("limits/{field}"), range.map(f64::to_degrees), 36_000.0, "degrees");
        }
    }
    let clearance = l.table_clearance.is_none_or(|least| (0.0..=LARGEST).contains(&least));
    checker.check(clearance, "limits/table_clearance", "must be a length between 0 and 1e6 mm");
    for (field, axes) in [("slider_axes", l.slider_axes), ("platform_axes", l.platform_axes)] {
        for (i, axis) in axes.iter().flatten().enumerate() {
            checker.check(
                direction(*axis).is_some(),
                &format!("limits/{field}/{i}"),
                "must be a direction: three finite numbers, not all zero",
            );
        }
    }
}

/// Velocities and accelerations must be positive; far from them, times would lose their precision.
fn drives(d: &Drives, checker: &mut Checker) {
    let in_degrees = |drive: Drive| Drive {
        velocity: drive.velocity.to_degrees(),
        acceleration: drive.acceleration.map(f64::to_degrees),
    };
    let each = [
        ("slider", d.slider, "mm"),
        ("tilt", in_degrees(d.tilt), "deg"),
        ("rotary", in_degrees(d.rotary), "deg"),
    ];
    for (name, drive, unit) in each {
        let limits =
            [("velocity", Some(drive.velocity), "s", 1e6), ("acceleration", drive.acceleration, "s²", 1e9)];
        for (field, value, time, most) in limits {
            let holds = value.is_none_or(|value| (LEAST_RATE..=most).contains(&value));
            let detail = format!("must be a number between {LEAST_RATE:e} and {most:e} {unit}/{time}");
            checker.check(holds, &format!("drives/{name}/{field}"), &detail);
        }
    }
}

/// Leg I's rods diverge or are parallel. Only if they are parallel does the platform not turn.
fn leg_one(g: &Geometry, checker: &mut Checker) {
    checker.check(
        g.R1 >= g.r1,
        "geometry/R1",
        "must be at least r1. In the working mode R1 cos alpha > r1, or R1 = r1 and alpha = 0; with R1 < r1 no angle \
         satisfies that",
    );
    checker.check(
        g.parallelogram_direction == 0.0 || g.R1 == g.r1,
        "geometry/parallelogram_direction",
        "must be 0 unless R1 = r1: with a platform that turns about x, parallelograms in another direction than x \
         would not stay parallelograms",
    );
}

/// At x = y = alpha = 0 every leg must reach the platform from above.
fn home(g: &Geometry, checker: &mut Checker) {
    let legs = [
        ("geometry/L1", g.L1, g.D1 - g.d1, g.R1 - g.r1),
        ("geometry/L2", g.L2, g.D2 - g.d2, g.R2 - g.r4),
        ("geometry/L3", g.L3, g.D2 - g.d2, g.R2 - g.r4),
    ];
    for (field, length, x, y) in legs {
        let needed = x.hypot(y);
        checker.check(
            length > needed * (1.0 + RELATIVE_LENGTH_RESERVE),
            field,
            &format!("must be longer than {needed:.6} mm, or there is no home pose at x = y = alpha = 0"),
        );
    }
}
