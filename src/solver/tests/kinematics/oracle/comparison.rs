//! Comparison of many answers of the solver with the oracle's; collects the disagreements.

use verne_solver::{KinematicsError, Machine, Posture, Postures};

use super::agreement::{Tally, agree, distance};
use super::legs::Legs;
use super::solution::Answer;

/// How many disagreements are printed.
const PRINTED: usize = 3;

/// Comparisons of one kind.
#[derive(Default)]
pub(crate) struct Comparison {
    pub(crate) tally: Tally,
    failures: Vec<String>,
}

impl Comparison {
    /// Compares one answer, residuals included.
    pub(crate) fn of(
        &mut self,
        question: &str,
        machine: &Machine,
        answer: &Answer,
        got: &Result<Postures, KinematicsError>,
    ) {
        let checked = self.check(machine, answer, got);
        self.failures.extend(checked.err().map(|what| format!("{question}: {what}")));
    }

    /// Compares the working mode alone: it is one of the oracle's, or refused if there is none.
    pub(crate) fn of_working(
        &mut self,
        question: &str,
        machine: &Machine,
        answer: &Answer,
        got: &Result<Posture, KinematicsError>,
    ) {
        let legs = Legs::of(machine);
        let mut working = answer.found.iter().filter(|found| found.working);
        let agrees = match got {
            Ok(posture) => working.any(|found| distance(&legs, found, posture) < 1e-8 * legs.scale()),
            Err(_) => !working.any(|found| found.signs_certain && !found.weak()),
        };
        if !agrees {
            self.failures.push(format!("{question}, working: {got:?}, the oracle has {:?}", answer.found));
        }
    }

    fn check(
        &mut self,
        machine: &Machine,
        answer: &Answer,
        got: &Result<Postures, KinematicsError>,
    ) -> Result<(), String> {
        let none = Postures::new();
        let postures = match got {
            Ok(postures) if !postures.is_empty() => postures,
            // Out of reach: the oracle must have found nothing either.
            Err(KinematicsError::Unreachable(margin)) if margin.value < 0.0 => &none,
            other => return Err(format!("{other:?}")),
        };
        if answer.continuum {
            return Err("a continuum of solutions".into());
        }
        agree(machine, answer, postures, &mut self.tally)?;
        let unit = Legs::of(machine).scale();
        for posture in postures {
            // Far from the origin, z and rho themselves have no more digits.
            let allowed = 9e-13 * unit + 4.0 * f64::EPSILON * posture.pose.z.abs();
            if posture.residual.is_nan() || posture.residual > allowed {
                return Err(format!("residual of {posture:?}"));
            }
        }
        Ok(())
    }

    /// No disagreement, no more than so many lenient comparisons, and so many solutions at least
    /// to make the comparison mean something.
    pub(crate) fn conclude(&self, lenient: usize, solutions: usize) {
        let (count, tally) = (self.failures.len(), &self.tally);
        let first = self.failures.iter().take(PRINTED).cloned().collect::<Vec<_>>().join("\n");
        assert!(count == 0, "{count} of {} differ; the first:\n{first}", tally.compared);
        assert!(tally.lenient <= lenient && tally.solutions >= solutions, "{tally:?}");
    }
}
