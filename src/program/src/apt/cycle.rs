//! The parameters of CYCLE. Every CAM system has its own words for them.

use crate::apt::feed::{Rate, rate};
use crate::apt::lexer::Token;
use crate::apt::statement::Statement;
use crate::drilling::PeckKind;
use crate::error::ProgramError;
use crate::event::Dwell;

/// A cycle: heights are along the tool axis above the programmed point, in the file's unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cycle {
    pub(crate) kind: CycleKind,
    /// Where the hole ends.
    pub(crate) bottom: f64,
    /// Where the feed begins.
    pub(crate) start: f64,
    /// Where the tool leaves to.
    pub(crate) retract: f64,
    /// The feed; without one, that of FEDRAT.
    pub(crate) feed: Option<(f64, Rate)>,
    /// The depth of one peck.
    pub(crate) step: Option<f64>,
    pub(crate) dwell: Option<Dwell>,
}

/// How a cycle cuts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CycleKind {
    /// In with the feed, out as a rapid.
    Drill,
    /// In and out with the feed.
    Bore,
    /// The same, and the controller reverses the spindle.
    Tap,
    /// In by pecks.
    Peck(PeckKind),
}

/// The effect of a CYCLE statement.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Switch {
    /// The points that follow are holes.
    Begin(Cycle),
    /// The same with the parameters of the cycle before.
    Resume,
    /// The points that follow are points.
    End,
    /// Nothing.
    Keep,
}

/// The meaning of a word in CYCLE.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Meaning {
    Kind(CycleKind),
    /// Depth below the point; a negative number is the height of the bottom (FEDTO of NX).
    Depth,
    Start,
    Retract,
    Step,
    Dwell,
    /// A number that does not concern the path.
    Number,
    /// A word that does not concern the path.
    Nothing,
}

/// The words of NX (FEDTO, RAPTO, RTRCTO), SolidWorks (the same with positive depths), Creo (DEPTH, CLEAR, RETURN) and
/// Fusion (positional: depth, clearance; INCR).
const WORDS: [(&str, Meaning); 39] = [
    ("DRILL", Meaning::Kind(CycleKind::Drill)),
    ("SPDRL", Meaning::Kind(CycleKind::Drill)),
    ("CDRILL", Meaning::Kind(CycleKind::Drill)),
    ("FACE", Meaning::Kind(CycleKind::Drill)),
    ("CBORE", Meaning::Kind(CycleKind::Drill)),
    ("THRU", Meaning::Kind(CycleKind::Drill)),
    ("REAM", Meaning::Kind(CycleKind::Bore)),
    ("BORE", Meaning::Kind(CycleKind::Bore)),
    ("TAP", Meaning::Kind(CycleKind::Tap)),
    ("DEEP", Meaning::Kind(CycleKind::Peck(PeckKind::Deep))),
    ("DEEP2", Meaning::Kind(CycleKind::Peck(PeckKind::Deep))),
    ("BRKCHP", Meaning::Kind(CycleKind::Peck(PeckKind::ChipBreak))),
    ("FEDTO", Meaning::Depth),
    ("DEPTH", Meaning::Depth),
    ("RAPTO", Meaning::Start),
    ("CLEAR", Meaning::Start),
    ("RTRCTO", Meaning::Retract),
    ("RETURN", Meaning::Retract),
    ("STEP", Meaning::Step),
    ("STEP1", Meaning::Step),
    ("INCR", Meaning::Step),
    ("PECK", Meaning::Step),
    ("DWELL", Meaning::Dwell),
    ("CSINK", Meaning::Number),
    ("HOLDIA", Meaning::Number),
    ("DIAMET", Meaning::Number),
    ("ORIENT", Meaning::Number),
    ("PITCH", Meaning::Number),
    ("TPI", Meaning::Number),
    ("ANGLE", Meaning::Number),
    ("STEP2", Meaning::Number),
    ("STEP3", Meaning::Number),
    ("RPM", Meaning::Number),
    ("TIMES", Meaning::Number),
    ("DRAG", Meaning::Nothing),
    ("NODRAG", Meaning::Nothing),
    ("AUTO", Meaning::Nothing),
    ("CLW", Meaning::Nothing),
    ("NONE", Meaning::Nothing),
];

const ACCEPTED: &str = "CYCLE/OFF, or DRILL, DEEP, BRKCHP, FACE, REAM, BORE or TAP with the depth (FEDTO or DEPTH), \
                        and RAPTO or CLEAR, RTRCTO or RETURN, STEP or INCR, DWELL, and a feed as in MMPM,200";

/// The values that were found so far.
#[derive(Default)]
struct Found {
    kind: Option<CycleKind>,
    bottom: Option<f64>,
    start: Option<f64>,
    retract: Option<f64>,
    step: Option<f64>,
    dwell: Option<Dwell>,
    feed: Option<(f64, Rate)>,
    /// Numbers without a word.
    positional: Vec<f64>,
}

/// Reads a CYCLE statement.
pub(crate) fn parse(statement: &Statement<'_>) -> Result<Switch, ProgramError> {
    let arguments = statement.arguments();
    match arguments.first().map(|token| token.text) {
        Some("OFF" | "NOMORE") => return Ok(Switch::End),
        Some("ON") => return Ok(Switch::Resume),
        Some("INIT") => return Ok(Switch::Keep),
        _ => {}
    }
    let mut found = Found::default();
    let mut rest = arguments;
    while let Some((token, tail)) = rest.split_first() {
        rest = found.take(statement, token, tail)?;
    }
    found.cycle().map(Switch::Begin).map_err(|detail| statement.fault(detail))
}

impl Found {
    /// Takes a token, and its number if it has one. Returns the tokens that are left.
    fn take<'t, 'a>(
        &mut self,
        statement: &Statement<'_>,
        token: &Token<'a>,
        tail: &'t [Token<'a>],
    ) -> Result<&'t [Token<'a>], ProgramError> {
        if token.number().is_some() {
            self.positional.push(statement.number(token, ACCEPTED)?);
            return Ok(tail);
        }
        let next = match tail.first() {
            Some(next) if next.number().is_some() => Some(statement.number(next, ACCEPTED)?),
            _ => None,
        };
        let rest = if next.is_some() { &tail[1..] } else { tail };
        if let Some(unit) = rate(token.text) {
            // The unit stands before its number; a unit that follows its number ends the list.
            let value = next.or_else(|| self.positional.pop());
            let value = value.ok_or_else(|| statement.fault_at(token, "the feed has no value".to_owned()))?;
            self.feed = Some((value, unit));
            return Ok(rest);
        }
        let known = WORDS.iter().find(|(word, _)| token.is(word));
        let Some((_, meaning)) = known else {
            let detail = format!("this cycle is not read; accepted are {ACCEPTED}");
            return Err(statement.fault_at(token, detail));
        };
        match meaning {
            Meaning::Kind(kind) => {
                self.kind = Some(*kind);
                return Ok(tail);
            }
            Meaning::Nothing => return Ok(tail),
            Meaning::Number => return Ok(rest),
            Meaning::Retract if next.is_none() => return Ok(tail),
            Meaning::Dwell => return self.take_dwell(statement, token, tail),
            Meaning::Depth | Meaning::Start | Meaning::Retract | Meaning::Step => {}
        }
        let value = next.ok_or_else(|| statement.fault_at(token, "the word needs a number".to_owned()))?;
        match meaning {
            Meaning::Depth => self.bottom = Some(-value.abs()),
            Meaning::Start => self.start = Some(value),
            Meaning::Retract => self.retract = Some(value),
            _ => self.step = Some(value),
        }
        Ok(rest)
    }

    /// DWELL with seconds, with REV and turns, or with ON.
    fn take_dwell<'t, 'a>(
        &mut self,
        statement: &Statement<'_>,
        token: &Token<'a>,
        tail: &'t [Token<'a>],
    ) -> Result<&'t [Token<'a>], ProgramError> {
        let (unit, tail) = match tail.split_first() {
            Some((word, rest)) if word.is("REV") || word.is("ON") => (word.text, rest),
            _ => ("", tail),
        };
        let Some((number, rest)) = tail.split_first().filter(|(number, _)| number.number().is_some()) else {
            return if unit == "ON" {
                Ok(tail)
            } else {
                Err(statement.fault_at(token, "DWELL needs seconds, or REV and turns".to_owned()))
            };
        };
        let value = statement.number(number, ACCEPTED)?;
        if value < 0.0 {
            return Err(statement.fault_at(number, "a dwell cannot be negative".to_owned()));
        }
        let dwell = if unit == "REV" { Dwell::Revolutions(value) } else { Dwell::Seconds(value) };
        self.dwell = Some(dwell).filter(|_| value > 0.0);
        Ok(rest)
    }

    /// The cycle, or what is missing.
    fn cycle(self) -> Result<Cycle, String> {
        let kind =
            self.kind.ok_or_else(|| format!("the kind of the cycle is missing; accepted: {ACCEPTED}"))?;
        let mut positional = self.positional.into_iter();
        let bottom = self.bottom.or_else(|| positional.next().map(|depth| -depth.abs()));
        let bottom = bottom.ok_or_else(|| format!("the cycle has no depth; accepted: {ACCEPTED}"))?;
        let clearance = positional.next();
        // Fusion writes the shift of fine boring last.
        if positional.len() > usize::from(kind == CycleKind::Bore) {
            return Err(format!("the cycle has numbers without words; accepted: {ACCEPTED}"));
        }
        let (start, retract) = match (clearance, self.start) {
            // Fusion: RAPTO leads down from the clearance.
            (Some(clearance), Some(down)) => (clearance - down, self.retract.unwrap_or(clearance)),
            (clearance, start) => {
                let start = start.or(clearance).unwrap_or(0.0);
                (start, self.retract.unwrap_or(start))
            }
        };
        if start < bottom {
            return Err(
                "the cycle begins below its depth; RAPTO or CLEAR is a height above the point".to_owned()
            );
        }
        if self.step.is_some_and(|step| step <= 0.0) {
            return Err("the step of a cycle must be positive".to_owned());
        }
        Ok(Cycle { kind, bottom, start, retract, feed: self.feed, step: self.step, dwell: self.dwell })
    }
}
