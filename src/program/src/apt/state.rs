//! The state that a CL reader keeps between statements.

use nalgebra::Vector3;

use crate::apt::cycle::Cycle;
use crate::apt::statement::Statement;
use crate::arc::Sweep;
use crate::builder::{Builder, ProgrammedFeed, Target};
use crate::error::ProgramError;
use crate::moves::MoveKind;
use crate::options::{ReadOptions, Units};
use crate::orientation::Orientation;

/// The state of a CL reader.
#[derive(Debug)]
pub(crate) struct State {
    pub(crate) builder: Builder,
    /// The unit of lengths, once it is known.
    pub(crate) units: Option<Units>,
    /// RAPID holds for the next motion.
    pub(crate) rapid: bool,
    pub(crate) feed: ProgrammedFeed,
    /// The present axis, a unit vector.
    pub(crate) axis: [f64; 3],
    /// MULTAX/OFF is in force.
    pub(crate) fixed_axis: bool,
    /// A circle whose end is still to come.
    pub(crate) arc: Option<PendingArc>,
    /// The cycle in force.
    pub(crate) cycle: Option<Cycle>,
    /// The cycle of CYCLE/ON.
    pub(crate) last_cycle: Option<Cycle>,
    pub(crate) frames: Frames,
    pub(crate) guides: Guides,
    /// The file is Creo's: a circle has several points.
    pub(crate) creo: bool,
    /// How the file is framed.
    pub(crate) extent: Extent,
}

/// A circle whose end is still to come.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PendingArc {
    /// mm.
    pub(crate) centre: [f64; 3],
    /// A unit vector.
    pub(crate) normal: [f64; 3],
    pub(crate) sweep: Sweep,
    /// The stated radius, mm.
    pub(crate) radius: Option<f64>,
    /// The angle of the points that were read already; the circle may end with them.
    pub(crate) swept: Option<f64>,
}

/// The coordinate systems of the file.
#[derive(Debug, Default)]
pub(crate) struct Frames {
    /// TRNTYP/WORLD is in force.
    pub(crate) world: bool,
    /// The fault of a CSYS that is not the identity, if points are not in world coordinates.
    pub(crate) local: Option<ProgramError>,
    /// The system of MSYS.
    pub(crate) machine: Option<[f64; 9]>,
}

/// The guides of a motion along a circle (TLON).
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Guides {
    /// The direction at the start.
    pub(crate) direction: Option<[f64; 3]>,
    /// The normal of the plane; without one, the tool axis.
    pub(crate) plane: Option<[f64; 3]>,
}

/// Words that begin and end a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Extent {
    /// Nothing says where the file ends.
    #[default]
    Open,
    /// The file has begun with PARTNO or TOOL PATH.
    Begun,
    /// The path has ended; another may follow.
    Ended,
    /// FINI: nothing follows.
    Finished,
}

impl State {
    pub(crate) fn new(options: &ReadOptions) -> Self {
        Self {
            builder: Builder::new(options),
            units: options.units,
            rapid: false,
            feed: ProgrammedFeed::default(),
            axis: [0.0, 0.0, 1.0],
            fixed_axis: false,
            arc: None,
            cycle: None,
            last_cycle: None,
            frames: Frames::default(),
            guides: Guides::default(),
            creo: false,
            extent: Extent::default(),
        }
    }

    /// The length of the file's unit in mm. If nothing states it, that is a fault, once.
    pub(crate) fn millimetres(&mut self, statement: &Statement<'_>) -> Result<f64, ProgramError> {
        let Some(units) = self.units else {
            self.units = Some(Units::Millimetres);
            let detail = "the unit of lengths is not known; write UNITS/MM or UNITS/INCHES before the first length, \
                          or state units=mm or units=inch in the request";
            return Err(statement.fault(detail.to_owned()));
        };
        Ok(units.millimetres())
    }

    /// Where the next motion leads. It uses up RAPID.
    pub(crate) fn target(&mut self, statement: &Statement<'_>, tip: [f64; 3]) -> Target {
        let kind = if std::mem::take(&mut self.rapid) { MoveKind::Rapid } else { MoveKind::Feed };
        if kind == MoveKind::Feed && self.feed == ProgrammedFeed::default() {
            let detail = "a feed move without FEDRAT: the drives decide";
            self.builder.diagnostics.warn(statement.line(), statement.word(), detail);
        }
        let orientation = Orientation::Vector(self.axis);
        Target { line: statement.line(), kind, tip, orientation, feed: self.feed }
    }

    /// The present tip, or a fault.
    pub(crate) fn position(&self, statement: &Statement<'_>) -> Result<Vector3<f64>, ProgramError> {
        let position = self.builder.position().map(|last| Vector3::from(last.tip()));
        position.ok_or_else(|| {
            let detail = "the present point is not known; write a GOTO with three coordinates before it";
            statement.fault(detail.to_owned())
        })
    }
}
