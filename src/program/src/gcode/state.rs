//! The state that a reader of G-code keeps between blocks.

use crate::builder::{Builder, ProgrammedFeed};
use crate::gcode::cycle::Cycle;
use crate::gcode::position::Position;
use crate::gcode::tilted_plane::TiltedPlane;
use crate::gcode::tool_axis::ToolAxis;
use crate::gcode::vocabulary::{FeedMode, Motion, Plane};
use crate::options::{ReadOptions, Units};
use crate::program::LengthSource;
use crate::work_offset::WorkOffset;

/// The state of a reader of G-code.
#[derive(Debug)]
pub(crate) struct State {
    pub(crate) builder: Builder,
    pub(crate) extent: Extent,
    /// The unit of lengths, once it is known.
    pub(crate) units: Option<Units>,
    /// G0 to G3, once one was stated.
    pub(crate) motion: Option<Motion>,
    /// The cycle in force.
    pub(crate) cycle: Option<Cycle>,
    pub(crate) modes: Modes,
    pub(crate) feed_mode: FeedMode,
    pub(crate) feed: ProgrammedFeed,
    /// G41 or G42.
    pub(crate) compensated: bool,
    pub(crate) tool: ToolState,
    pub(crate) centre_point: CentrePoint,
    pub(crate) offset: WorkOffset,
    pub(crate) tilt: Option<TiltedPlane>,
    pub(crate) position: Position,
    pub(crate) axis: ToolAxis,
}

/// The meaning of coordinates.
#[derive(Debug)]
pub(crate) struct Modes {
    pub(crate) plane: Plane,
    /// G91.
    pub(crate) incremental: bool,
    /// G90.1.
    pub(crate) centre_absolute: bool,
    /// G98.
    pub(crate) return_to_initial: bool,
}

impl Default for Modes {
    fn default() -> Self {
        Self { plane: Plane::default(), incremental: false, centre_absolute: false, return_to_initial: true }
    }
}

/// How the program is framed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Extent {
    /// No block was read yet. `percent` says whether a `%` stands before.
    #[default]
    Empty,
    /// `%` stands before the first block.
    Marked,
    /// Blocks were read.
    Open,
    /// The same after `%`: another `%` ends the program.
    OpenMarked,
    /// M2, M30 or the second `%`: nothing follows.
    Finished,
}

/// Tools and lengths.
#[derive(Debug, Default)]
pub(crate) struct ToolState {
    /// T: the tool that M6 will load, and the line that says so.
    pub(crate) selected: Option<(u32, u32)>,
    /// The tool that M6 loaded.
    pub(crate) loaded: Option<u32>,
    /// The last H since the tool was loaded.
    pub(crate) entry: Option<u32>,
    /// The entry whose length is in force.
    pub(crate) length: Option<u32>,
}

/// Control of the tool centre point.
#[derive(Debug, Default)]
pub(crate) struct CentrePoint {
    /// The request says that it is always on.
    pub(crate) always: bool,
    /// G43.4 or G43.5 is in force.
    pub(crate) by_length: Option<AxisWords>,
    /// A code of the request has begun it.
    pub(crate) by_code: bool,
}

/// How blocks state the axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum AxisWords {
    /// G43.4: A or B, and C.
    Angles,
    /// G43.5: I, J, K.
    Vector,
}

impl CentrePoint {
    /// Whether I, J, K are the axis.
    pub(crate) fn has_vector(&self) -> bool {
        self.by_length == Some(AxisWords::Vector)
    }

    pub(crate) fn is_on(&self) -> bool {
        self.always || self.by_length.is_some() || self.by_code
    }
}

impl State {
    pub(crate) fn new(options: &ReadOptions) -> Self {
        let mut builder = Builder::new(options);
        builder.set_length_source(LengthSource::Offset);
        Self {
            builder,
            extent: Extent::default(),
            units: options.units,
            motion: None,
            cycle: None,
            modes: Modes::default(),
            feed_mode: FeedMode::default(),
            feed: ProgrammedFeed::default(),
            compensated: false,
            tool: ToolState::default(),
            centre_point: CentrePoint { always: options.tcp, ..CentrePoint::default() },
            offset: WorkOffset::default(),
            tilt: None,
            position: Position::default(),
            axis: ToolAxis::default(),
        }
    }

    /// The length of the program's unit in mm. If nothing states it, it is a millimetre, with a warning.
    pub(crate) fn millimetres(&mut self, line: u32) -> f64 {
        let units = *self.units.get_or_insert_with(|| {
            let detail = "neither G20 nor G21 states the unit of lengths: it is taken as mm";
            self.builder.diagnostics.warn(line, "", detail);
            Units::Millimetres
        });
        units.millimetres()
    }
}
