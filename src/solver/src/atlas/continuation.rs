//! Newton's method and continuation along a curve in the space of configurations.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix4, SMatrix, SVector};

use super::leg_one::Branch;
use super::place::Configuration;
use super::request::Space;
use super::scalar::COORDINATES;
use super::target::System;

/// Newton steps, and the last step with which the iteration has converged.
const STEPS: usize = 10;
const CONVERGED: f64 = 1e-12;
/// A correction beyond this has gone astray.
const FAR: f64 = 0.5;
/// Distance within which two configurations are the same.
const SAME: f64 = 1e-7;
/// Lengths of steps: the first, the greatest and the least.
const FIRST: f64 = 0.02;
const GREATEST: f64 = 0.12;
const LEAST: f64 = 1e-9;
/// Cosine of the angle between the tangents at both ends of a step: at least the first, and if it is above the second
/// the next step is longer.
const TURNS: [f64; 2] = [0.97, 0.995];
/// A step shorter than this may cross a point at which the curve crosses itself.
const CROSSING: f64 = 1e-5;
/// Greatest correction of a step, relative to its length.
const CORRECTION: f64 = 0.25;
/// Most steps along one curve.
const MOST: usize = 20_000;

pub(super) fn dot(a: &Configuration, b: &Configuration) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(super) fn norm(a: &Configuration) -> f64 {
    dot(a, a).sqrt()
}

/// a + (b - a) · fraction.
pub(super) fn mixed(a: &Configuration, b: &Configuration, fraction: f64) -> Configuration {
    std::array::from_fn(|i| a[i] + (b[i] - a[i]) * fraction)
}

/// Where a walk along a curve ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// At its start: the curve is closed.
    Start,
    /// Where a bound is zero.
    Bound,
    /// Where the caller wanted no more, or where no step was possible.
    Open,
}

/// A point of a walk along a curve.
struct Walker {
    q: Configuration,
    tangent: Configuration,
    /// Whether the walk is along the tangent or against it.
    sense: f64,
    /// Length of the next step.
    length: f64,
}

impl System<'_> {
    /// The point of the curve in the plane through `guess` with this normal.
    pub(super) fn corrected(&self, guess: &Configuration, normal: &Configuration) -> Option<Configuration> {
        let mut q = *guess;
        for _ in 0..STEPS {
            let next = self.newton_step(&q, guess, normal)?;
            let length = norm(&std::array::from_fn(|i| next[i] - q[i]));
            q = next;
            if length < CONVERGED {
                return Some(q);
            }
        }
        None
    }

    /// A step of Newton's method for the point of the curve in the plane through `guess` with this normal.
    pub(super) fn newton_step(
        &self,
        q: &Configuration,
        guess: &Configuration,
        normal: &Configuration,
    ) -> Option<Configuration> {
        let (values, slopes) = self.linearised(q);
        let offset: Configuration = std::array::from_fn(|i| q[i] - guess[i]);
        let matrix = SMatrix::<f64, COORDINATES, COORDINATES>::from_fn(|row, column| {
            if row < 4 { slopes[row][column] } else { normal[column] }
        });
        let right =
            SVector::<f64, COORDINATES>::from_fn(
                |row, _| {
                    if row < 4 { values[row] } else { dot(normal, &offset) }
                },
            );
        let step = matrix.lu().solve(&right)?;
        let length = step.norm();
        (length.is_finite() && length <= FAR).then(|| std::array::from_fn(|i| q[i] - step[i]))
    }

    /// The unit tangent of the curve, with one sense all along it. `None` where the curve has none.
    pub(super) fn tangent(&self, q: &Configuration) -> Option<Configuration> {
        let (_, slopes) = self.linearised(q);
        // The generalised cross product of the four gradients.
        let minor = |skipped: usize| {
            let matrix = Matrix4::from_fn(|row, column| {
                slopes[row][if column < skipped { column } else { column + 1 }]
            });
            let determinant = matrix.determinant();
            if skipped.is_multiple_of(2) { determinant } else { -determinant }
        };
        let tangent: Configuration = std::array::from_fn(minor);
        let length = norm(&tangent);
        (length > 1e-300).then(|| tangent.map(|component| component / length))
    }

    /// The point of the curve between two of its points.
    pub(super) fn between(
        &self,
        a: &Configuration,
        b: &Configuration,
        fraction: f64,
    ) -> Option<Configuration> {
        let normal: Configuration = std::array::from_fn(|i| b[i] - a[i]);
        let length = norm(&normal);
        if length < 1e-14 {
            return Some(*a);
        }
        let found = self.corrected(&mixed(a, b, fraction), &normal.map(|component| component / length))?;
        // Not further from the chord than the chord is long.
        let off: Configuration = std::array::from_fn(|i| found[i] - mixed(a, b, fraction)[i]);
        (norm(&off) <= length).then_some(found)
    }

    /// Whether a point of the curve lies between two near ones.
    pub(super) fn contains(&self, [a, b]: [&Configuration; 2], point: &Configuration) -> bool {
        let chord: Configuration = std::array::from_fn(|i| b[i] - a[i]);
        // X1, w2 and w3 are the same in all images, and exclude most chords.
        let slack = 0.31 * norm(&chord) + 1e-6;
        let is_near = |i: usize| (a[i].min(b[i]) - slack..=a[i].max(b[i]) + slack).contains(&point[i]);
        if ![0, 3, 4].into_iter().all(is_near) {
            return false;
        }
        self.images(point).into_iter().any(|mut point| {
            self.turn_near(&mut point, a);
            let offset: Configuration = std::array::from_fn(|i| point[i] - a[i]);
            let square = dot(&chord, &chord);
            let fraction = dot(&offset, &chord) / square;
            let chord_point = mixed(a, b, fraction);
            let off: Configuration = std::array::from_fn(|i| point[i] - chord_point[i]);
            if !(-1e-6..=1.0 + 1e-6).contains(&fraction) || norm(&off) > 0.3 * square.sqrt() + SAME {
                return false;
            }
            self.between(a, b, fraction).is_some_and(|found| {
                let apart: Configuration = std::array::from_fn(|i| found[i] - point[i]);
                norm(&apart) < SAME
            })
        })
    }

    /// Walks along the curve from a point of it, in the sense of the tangent or against it, as long as `wants` the
    /// points. The points follow the start.
    pub(super) fn walk(
        &self,
        start: &Configuration,
        sense: f64,
        wants: impl Fn(&Configuration) -> bool,
    ) -> (Vec<Configuration>, End) {
        let mut points: Vec<Configuration> = Vec::new();
        let Some(first) = self.tangent(start) else { return (points, End::Open) };
        let mut place = Walker { q: *start, tangent: first, sense, length: FIRST };
        while points.len() < MOST {
            let Some(next) = self.step(&place) else { break };
            if self.reserve(&next.q) < 0.0 {
                points.extend(self.bound_between(&place.q, &next.q));
                return (points, End::Bound);
            }
            if points.len() >= 2 && self.contains([&place.q, &next.q], start) {
                return (points, End::Start);
            }
            points.push(next.q);
            if !wants(&next.q) {
                break;
            }
            place = next;
        }
        (points, End::Open)
    }

    /// The next point. The tangent has the same sense all along a curve, but the opposite one on the curve beside
    /// it. So a step that leads to another curve is refused, unless it is so short that the two cross within it.
    fn step(&self, from: &Walker) -> Option<Walker> {
        let mut length = from.length;
        let along = from.tangent.map(|component| component * from.sense);
        while length > LEAST {
            let guess: Configuration = std::array::from_fn(|i| from.q[i] + length * along[i]);
            let found = self.corrected(&guess, &along).and_then(|q| {
                let off: Configuration = std::array::from_fn(|i| q[i] - guess[i]);
                let tangent = self.tangent(&q)?;
                let turn = dot(&tangent, &from.tangent);
                let is_other_sense = turn < 0.0 && length < CROSSING;
                let sense = if is_other_sense { -from.sense } else { from.sense };
                let turn = if is_other_sense { -turn } else { turn };
                let next = Walker { q, tangent, sense, length };
                (norm(&off) <= CORRECTION * length && turn >= TURNS[0]).then_some((next, turn))
            });
            if let Some((next, turn)) = found {
                let length = if turn > TURNS[1] { (1.6 * length).min(GREATEST) } else { length };
                return Some(Walker { length, ..next });
            }
            length *= 0.5;
        }
        None
    }

    /// Where the least bound becomes zero between two points of the curve: positive at the first, negative at the
    /// second.
    fn bound_between(&self, a: &Configuration, b: &Configuration) -> Option<Configuration> {
        self.zero_between([a, b], |q| self.reserve(q))
    }

    /// Where a function that is positive at `a` and negative at `b` becomes zero on the curve between them.
    pub(super) fn zero_between(
        &self,
        [a, b]: [&Configuration; 2],
        function: impl Fn(&Configuration) -> f64,
    ) -> Option<Configuration> {
        let [start, end] = [function(a), function(b)];
        if start == 0.0 {
            return Some(*a);
        }
        let at = crate::workspace::zero(start, end, 1e-14, |fraction| {
            self.between(a, b, fraction).map_or(f64::NAN, |q| function(&q))
        });
        self.between(a, b, at)
    }

    /// The start of a closed curve as the point that follows its last one.
    pub(super) fn closing(&self, last: Configuration, start: &Configuration) -> Option<Configuration> {
        let near = |point: Configuration| {
            let mut point = point;
            self.turn_near(&mut point, &last);
            point
        };
        let distance = |point: &Configuration| norm(&std::array::from_fn(|i| point[i] - last[i]));
        self.images(start).into_iter().map(near).min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// Turns φ of a configuration by whole turns to be near that of another.
    fn turn_near(&self, q: &mut Configuration, other: &Configuration) {
        if self.shape.branch != Branch::Level {
            q[2] += TAU * ((other[2] - q[2]) / TAU).round();
        }
    }

    /// The mirror image of a configuration: of the platform with its x and y, or of the sliders with the opposite
    /// differences.
    pub(super) fn mirrored(&self, [x1, second, third, w2, w3]: &Configuration) -> Configuration {
        // (y, w1, a) becomes (y, -w1, -a).
        let second = if self.shape.branch == Branch::Level { *second } else { -second };
        match self.space {
            Space::Platform => [*x1, second, -third, *w2, *w3],
            Space::Joints => [*x1, second, -third, -w2, -w3],
        }
    }

    /// The configurations that are the same point: the crossed branch has two coordinates for one, and in the plane
    /// of the platform mirror images are the same.
    fn images(&self, q: &Configuration) -> Vec<Configuration> {
        let mut images = vec![*q];
        if self.shape.branch == Branch::Crossed {
            images.push([q[0], -q[1], q[2] + PI, q[3], q[4]]);
        }
        if self.space == Space::Platform {
            let mirrored: Vec<Configuration> = images.iter().map(|q| self.mirrored(q)).collect();
            images.extend(mirrored);
        }
        images
    }
}
