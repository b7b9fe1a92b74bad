//! The outer integral: panels between the lines at which the structure changes.

use super::super::domain::Domain;
use super::super::narrow::narrowed;
use super::super::observer::{Observer, go_on};
use super::super::quadrature::{Integral, rule};
use super::super::request::WorkspaceError;
use super::line::{Extremes, Line, Structure};

/// Lines first looked at, and the pieces of each: odd, so that the symmetry plane is not an end.
const COARSE: Look = Look { lines: 40, pieces: 13 };
/// The same for a domain in several pieces, some of which may be narrow.
const FINE: Look = Look { lines: 400, pieces: 53 };
/// Width, as a part of the domain's, within which a change of structure is found.
const RESOLUTION: f64 = 2e-9;
/// Aim of the relative error of each integral.
const ACCURACY: f64 = 1e-7;
/// Halvings of a panel.
const DEPTH: u32 = 14;
/// Errors are given larger than they are estimated.
const SAFETY: f64 = 2.0;

/// Area and signed volume.
pub(super) fn integrate(
    domain: &Domain<'_>,
    observer: &dyn Observer,
) -> Result<(Integral<2>, Extremes), WorkspaceError> {
    let Some([[mut x0, mut y0], [mut x1, mut y1]]) = narrowed(domain) else {
        return Ok((Integral::ZERO, Extremes::default()));
    };
    let mut outer = Outer {
        domain,
        range: [y0, y1],
        observer,
        look: COARSE,
        parted: false,
        extremes: Extremes::default(),
    };
    let (mut ends, mut rough) = outer.changes([x0, x1])?;
    if outer.parted {
        // A piece may also lie beside what the others occupy.
        [[x0, y0], [x1, y1]] = domain.rectangle();
        (outer.look, outer.range) = (FINE, [y0, y1]);
        (ends, rough) = outer.changes([x0, x1])?;
    }
    let mut total = Integral::ZERO;
    let allowed = rough.map(|r| r * ACCURACY);
    for panel in ends.windows(2) {
        observer.progress(0.5 + 0.5 * (panel[0] - x0) / (x1 - x0));
        total.add(&outer.panel([panel[0], panel[1]], [0.0, 1.0], &rough, &allowed, DEPTH)?);
    }
    // Between a change and its computed place a line may be twice as long as the mean one.
    let misplaced = 2.0 * RESOLUTION * f64::from(u32::try_from(ends.len()).unwrap_or(u32::MAX));
    for (error, rough) in total.error.iter_mut().zip(rough) {
        *error = SAFETY * *error + misplaced * rough;
    }
    Ok((total, outer.extremes))
}

/// How closely a domain is looked at.
#[derive(Clone, Copy)]
struct Look {
    lines: u32,
    pieces: u32,
}

struct Outer<'a> {
    domain: &'a Domain<'a>,
    range: [f64; 2],
    observer: &'a dyn Observer,
    look: Look,
    /// Whether a line crossed several pieces of the domain.
    parted: bool,
    extremes: Extremes,
}

impl Outer<'_> {
    fn line(&self, x: f64) -> Result<Line<'_>, WorkspaceError> {
        go_on(self.observer)?;
        Ok(Line::new(self.domain, x, self.range, self.look.pieces))
    }

    /// The x between which the structure stays the same, and rough values of the integrals.
    fn changes(&mut self, [x0, x1]: [f64; 2]) -> Result<(Vec<f64>, [f64; 2]), WorkspaceError> {
        let lines = self.look.lines;
        let step = (x1 - x0) / f64::from(lines);
        let (mut found, mut rough) = (vec![], [0.0; 2]);
        let mut last: Option<(f64, Structure)> = None;
        for number in 0..=lines {
            self.observer.progress(0.5 * f64::from(number) / f64::from(lines));
            let x = x0 + step * f64::from(number);
            let line = self.line(x)?;
            let parted = line.is_parted();
            let structure = line.structure();
            let mut extremes = Extremes::default();
            let value = line.integrals(&[f64::INFINITY; 2], &mut extremes).value;
            for (rough, value) in rough.iter_mut().zip(value) {
                *rough += step * value.abs();
            }
            self.parted |= parted;
            if let Some((before, old)) = last {
                self.change([before, x], [&old, &structure], RESOLUTION * (x1 - x0), &mut found)?;
            }
            last = Some((x, structure));
        }
        // Changes that cannot be told apart are one.
        found.dedup_by(|b, a| *b - *a <= 2.0 * RESOLUTION * (x1 - x0));
        Ok((found, rough))
    }

    fn change(
        &self,
        [a, b]: [f64; 2],
        [old, new]: [&Structure; 2],
        least: f64,
        found: &mut Vec<f64>,
    ) -> Result<(), WorkspaceError> {
        if old == new {
            return Ok(());
        }
        let middle = 0.5 * (a + b);
        if b - a <= least {
            found.push(middle);
            return Ok(());
        }
        let between = self.line(middle)?.structure();
        self.change([a, middle], [old, &between], least, found)?;
        self.change([middle, b], [&between, new], least, found)
    }

    /// The part `[from, to]` of a panel, in the parameter t of the substitution.
    fn panel(
        &mut self,
        panel: [f64; 2],
        [from, to]: [f64; 2],
        rough: &[f64; 2],
        allowed: &[f64; 2],
        depth: u32,
    ) -> Result<Integral<2>, WorkspaceError> {
        let width = panel[1] - panel[0];
        let mut extremes = self.extremes;
        let whole = rule([from, to], |t| {
            let x = panel[0] + width * t * t * (3.0 - 2.0 * t);
            let weight = width * 6.0 * t * (1.0 - t);
            let mut part = self.line(x)?.integrals(&rough.map(|r| r / width), &mut extremes);
            part.value = part.value.map(|v| v * weight);
            part.error = part.error.map(|e| e * weight);
            Ok(part)
        })?;
        self.extremes = extremes;
        if depth == 0 || whole.within(allowed) {
            return Ok(whole);
        }
        let middle = 0.5 * (from + to);
        let allowed = allowed.map(|a| 0.5 * a);
        let mut total = self.panel(panel, [from, middle], rough, &allowed, depth - 1)?;
        total.add(&self.panel(panel, [middle, to], rough, &allowed, depth - 1)?);
        Ok(total)
    }
}
