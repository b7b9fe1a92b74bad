//! Volumes of the two regions: numerical integration over x and over the radius about the tilting axis, closed form
//! over the angle psi.

use rayon::prelude::*;

use super::monotone_piece::MonotonePiece;
use super::reach_angles::reach_angles;
use super::request::DexterityRequest;
use super::section::ToolWorkspace;
use crate::machine::Machine;
use crate::workspace::measure::Volume;
use crate::workspace::observer::{Observer, ProgressCounter, check_cancelled, count};
use crate::workspace::quadrature::{Integral, adaptive};
use crate::workspace::request::WorkspaceError;

/// Number of sections from which the range of x is found.
const SECTIONS: u32 = 96;
/// Panels along x and along the radius, and how often each may be halved.
const PANELS: [u32; 2] = [8, 4];
const DEPTH: [u32; 2] = [2, 6];
/// Aim of the relative error.
const ACCURACY: f64 = 5e-4;
/// Factor by which the stated errors exceed the estimates.
const SAFETY: f64 = 2.0;
/// Bisection steps for the x at which the set begins or ends.
const HALVINGS: u32 = 40;

/// Computes the volumes of what some phi1 of the range reaches and of what every phi1 of the range reaches. The errors
/// are twice the quadrature's estimates, not bounds.
///
/// A region narrower than a hundredth of the machine along x may be missed. The answer is [`Volume::Folded`] if the
/// part's map may fold.
///
/// # Units
///
/// mm³.
///
/// # Errors
///
/// - [`WorkspaceError::OutOfDomain`]: a number is not finite or beyond [`MAX_INPUT`](crate::MAX_INPUT), the range of
///   phi1 is not ordered or longer than a revolution, or the cell is below 0.1 mm.
/// - [`WorkspaceError::Cancelled`]: the observer asked to stop.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (9), (14), (26), (27); the
/// intervals are derived in the [workspace documentation](crate::workspace).
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::workspace::dexterity::{DexterityRequest, volumes};
/// use verne_solver::workspace::{Unobserved, Volume, WorkspaceError};
///
/// let request = DexterityRequest { tool_length: 150.0, ..DexterityRequest::new([-0.5, 0.5], 200.0) };
/// let machine = Machine::verne();
/// let [some, all] = volumes(&machine, &request, &Unobserved)?;
/// let value = |volume| if let Volume::Value { value, .. } = volume { Some(value) } else { None };
/// assert!(value(all) < value(some));
/// # Ok::<(), WorkspaceError>(())
/// ```
pub fn volumes(
    machine: &Machine,
    request: &DexterityRequest,
    observer: &dyn Observer,
) -> Result<[Volume; 2], WorkspaceError> {
    request.check()?;
    let tool = ToolWorkspace::new(machine, request);
    let integral = VolumeIntegral { tool: &tool, phi1: request.phi1, observer };
    let ranges = integral.ranges()?;
    let panels = ranges.len() * PANELS[0] as usize;
    let rough: Vec<[f64; 2]> =
        ranges.par_iter().map(|&range| integral.rough(range)).collect::<Result<_, WorkspaceError>>()?;
    let total = rough.iter().fold([0.0; 2], |sum, range| [0, 1].map(|n| sum[n] + range[n]));
    let allowed = total.map(|total| ACCURACY * total / count(panels));
    let progress = ProgressCounter::new(observer, panels);
    let panels: Vec<(Integral<2>, bool)> = (0..panels)
        .into_par_iter()
        .map(|number| {
            let range = ranges[number / PANELS[0] as usize];
            let within = number % PANELS[0] as usize;
            let panel = integral.panel(range, within, &allowed)?;
            progress.finished(1);
            Ok(panel)
        })
        .collect::<Result<_, WorkspaceError>>()?;
    let mut sum = Integral::ZERO;
    for (panel, _) in &panels {
        sum.add(panel);
    }
    let folded = panels.iter().any(|(_, folded)| *folded);
    Ok([0, 1].map(|n| {
        if folded {
            return Volume::Folded;
        }
        let rounding = 1e-9 * sum.value[n];
        Volume::Value { value: sum.value[n], error: SAFETY * sum.error[n] + rounding }
    }))
}

struct VolumeIntegral<'a> {
    tool: &'a ToolWorkspace<'a>,
    phi1: [f64; 2],
    observer: &'a dyn Observer,
}

impl VolumeIntegral<'_> {
    /// The ranges of x in which sections are not empty.
    fn ranges(&self) -> Result<Vec<[f64; 2]>, WorkspaceError> {
        let [low, high] = self.tool.domain.rectangle();
        let step = (high[0] - low[0]) / f64::from(SECTIONS);
        let (mut ranges, mut last): (Vec<[f64; 2]>, Option<f64>) = (Vec::new(), None);
        for number in 0..=SECTIONS {
            check_cancelled(self.observer)?;
            let x = low[0] + step * f64::from(number);
            let there = !self.tool.section(x).is_empty();
            match (there, last) {
                (true, None) => {
                    let from = if number == 0 { x } else { self.end(x, x - step)? };
                    ranges.push([from, x]);
                }
                (false, Some(before)) => {
                    if let Some(range) = ranges.last_mut() {
                        range[1] = self.end(before, x)?;
                    }
                }
                (true, Some(_)) => {
                    if let Some(range) = ranges.last_mut() {
                        range[1] = x;
                    }
                }
                (false, None) => {}
            }
            last = there.then_some(x);
        }
        Ok(ranges)
    }

    /// Finds the x between `inside` and `outside` beyond which sections are empty.
    fn end(&self, mut inside: f64, mut outside: f64) -> Result<f64, WorkspaceError> {
        for _ in 0..HALVINGS {
            check_cancelled(self.observer)?;
            let middle = 0.5 * (inside + outside);
            if self.tool.section(middle).is_empty() { outside = middle } else { inside = middle }
        }
        Ok(inside)
    }

    /// A rough value, which sets the scale of the allowed errors.
    fn rough(&self, [from, to]: [f64; 2]) -> Result<[f64; 2], WorkspaceError> {
        let mut sum = [0.0; 2];
        for fraction in [0.1, 0.3, 0.5, 0.7, 0.9] {
            let (area, _) = self.area(from + fraction * (to - from), &[f64::INFINITY; 2])?;
            sum = [0, 1].map(|n| sum[n] + 0.2 * (to - from) * area.value[n]);
        }
        Ok(sum)
    }

    /// Integrates one of the panels of a range of x, and tells whether the part's map may fold there.
    ///
    /// Towards the ends of x the section's area goes like a root: 3 t² - 2 t³ makes it smooth.
    fn panel(
        &self,
        range: [f64; 2],
        number: usize,
        allowed: &[f64; 2],
    ) -> Result<(Integral<2>, bool), WorkspaceError> {
        let width = range[1] - range[0];
        let mut folded = false;
        let ends = [number, number + 1].map(|end| count(end) / f64::from(PANELS[0]));
        let integral = adaptive(ends, allowed, DEPTH[0], &mut |t, length, allowed| {
            let weight = 6.0 * width * t * (1.0 - t);
            let allowed = allowed.map(|allowed| 0.3 * allowed / length / weight);
            let (area, fold) = self.area(range[0] + width * t * t * (3.0 - 2.0 * t), &allowed)?;
            folded |= fold;
            Ok::<_, WorkspaceError>(area.times(weight))
        })?;
        Ok((integral, folded))
    }

    /// Computes the areas of a section's reachable and dexterous regions, and whether the part's map may fold there.
    fn area(&self, x: f64, allowed: &[f64; 2]) -> Result<(Integral<2>, bool), WorkspaceError> {
        let section = self.tool.section(x);
        let mut sum = Integral::ZERO;
        let Some([least, greatest]) = radii(&section) else { return Ok((sum, false)) };
        let step = (greatest - least) / f64::from(PANELS[1]);
        let allowed = allowed.map(|allowed| allowed / f64::from(PANELS[1]));
        for panel in 0..PANELS[1] {
            let from = least + step * f64::from(panel);
            sum.add(&self.ring(&section, [from, from + step], &allowed)?);
        }
        Ok((sum, section.iter().any(|piece| piece.folds)))
    }

    fn ring(
        &self,
        section: &[MonotonePiece],
        radii: [f64; 2],
        allowed: &[f64; 2],
    ) -> Result<Integral<2>, WorkspaceError> {
        adaptive(radii, allowed, DEPTH[1], &mut |radius, _, _| {
            check_cancelled(self.observer)?;
            let value = reach_angles(self.tool, section, radius, self.phi1).map(|angle| angle * radius);
            Ok(Integral { value, error: [0.0; 2] })
        })
    }
}

/// The least and the greatest distance of a section's outline from the axis, and some room.
fn radii(section: &[MonotonePiece]) -> Option<[f64; 2]> {
    let mut found: Option<[f64; 2]> = None;
    for piece in section {
        let [low, high] = piece.zetas;
        let [from, to] = piece.range();
        let beside = |[low, high]: [f64; 2]| f64::max(0.0, f64::max(low, -high));
        let far = |[low, high]: [f64; 2]| f64::max(low.abs(), high.abs());
        let least = beside([from, to]).hypot(beside([low, high]));
        let greatest = far([from, to]).hypot(far([low, high]));
        let [a, b] = found.unwrap_or([least, greatest]);
        found = Some([a.min(least), b.max(greatest)]);
    }
    found
}
