//! The G and M codes that are known, and their modal groups.

use crate::drilling::PeckKind;
use crate::event::{Coolant, Rotation};
use crate::options::Units;
use crate::work_offset::WorkOffset;

/// The effect of a G code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Meaning {
    Motion(Motion),
    Cycle(CycleKind),
    CycleOff,
    Plane(Plane),
    Units(Units),
    Compensation(bool),
    Length(Length),
    Offset(WorkOffset),
    /// G61 and G64: how exactly the controller follows the path.
    PathControl,
    Incremental(bool),
    /// G90.1: I, J, K of arcs are coordinates of the centre.
    CentreAbsolute(bool),
    FeedMode(FeedMode),
    /// G98: after a hole, back to the height before the cycle.
    ReturnToInitial(bool),
    Dwell,
    Reference,
    MachineCoordinates,
    Tilt,
    /// G53.1: the axis turns to the normal of the tilted plane.
    Align,
    Untilt,
}

/// G0 to G3.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Motion {
    Rapid,
    Feed,
    Clockwise,
    CounterClockwise,
}

/// How a cycle cuts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CycleKind {
    /// G81 and, with a dwell, G82: in with the feed, out as a rapid.
    Drill { dwell: bool },
    /// G83 and G73.
    Peck(PeckKind),
    /// G85 and, with a dwell, G89: in and out with the feed.
    Bore { dwell: bool },
}

/// The plane of arcs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Plane {
    #[default]
    Xy,
    Zx,
    Yz,
}

/// Tool length compensation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Length {
    /// G43.
    Along,
    /// G43.4: control of the tool centre point with rotary words.
    Rotary,
    /// G43.5: control of the tool centre point with the axis as I, J, K.
    Vector,
    /// G49.
    Off,
}

/// The meaning of F.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum FeedMode {
    InverseTime,
    #[default]
    PerMinute,
    PerRevolution,
}

/// Codes of one group exclude each other in a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Group {
    Motion,
    CycleOff,
    Plane,
    Units,
    Compensation,
    Length,
    Offset,
    PathControl,
    Distance,
    CentreDistance,
    FeedMode,
    Return,
    Tilt,
    /// Codes for one block, which use its words.
    Once,
}

/// The number of groups.
pub(crate) const GROUPS: usize = Group::Once as usize + 1;

impl Meaning {
    pub(crate) fn group(self) -> Group {
        match self {
            Self::Motion(_) | Self::Cycle(_) => Group::Motion,
            Self::CycleOff => Group::CycleOff,
            Self::Plane(_) => Group::Plane,
            Self::Units(_) => Group::Units,
            Self::Compensation(_) => Group::Compensation,
            Self::Length(_) => Group::Length,
            Self::Offset(_) => Group::Offset,
            Self::PathControl => Group::PathControl,
            Self::Incremental(_) => Group::Distance,
            Self::CentreAbsolute(_) => Group::CentreDistance,
            Self::FeedMode(_) => Group::FeedMode,
            Self::ReturnToInitial(_) => Group::Return,
            Self::Tilt | Self::Untilt => Group::Tilt,
            Self::Dwell | Self::Reference | Self::MachineCoordinates | Self::Align => Group::Once,
        }
    }
}

/// The detail of the fault of a code that no table knows.
const UNKNOWN: &str = "the G code is not known; accepted are G0 to G4, G17 to G21, G28, G30, G40 to G43, G43.4, G43.5, \
                       G49, G53, G53.1, G54 to G59.3, G61, G64, G68.2, G69, G73, G80 to G83, G85, G89, G90, G91, \
                       G90.1, G91.1, G93 to G95, G98 and G99";

/// The meaning of a G code, or why it is refused.
pub(crate) fn general(tenths: u32) -> Result<Meaning, &'static str> {
    use Meaning as M;
    Ok(match tenths {
        0 => M::Motion(Motion::Rapid),
        10 => M::Motion(Motion::Feed),
        20 => M::Motion(Motion::Clockwise),
        30 => M::Motion(Motion::CounterClockwise),
        40 => M::Dwell,
        170 => M::Plane(Plane::Xy),
        180 => M::Plane(Plane::Zx),
        190 => M::Plane(Plane::Yz),
        200 => M::Units(Units::Inches),
        210 => M::Units(Units::Millimetres),
        280 | 300 => M::Reference,
        400 => M::Compensation(false),
        410 | 411 | 420 | 421 => M::Compensation(true),
        430 => M::Length(Length::Along),
        434 => M::Length(Length::Rotary),
        435 => M::Length(Length::Vector),
        490 => M::Length(Length::Off),
        530 => M::MachineCoordinates,
        531 => M::Align,
        540 | 550 | 560 | 570 | 580 | 590..=593 => return offset(tenths).map(M::Offset).ok_or(UNKNOWN),
        610 | 611 | 640 => M::PathControl,
        682 => M::Tilt,
        690 => M::Untilt,
        730 => M::Cycle(CycleKind::Peck(PeckKind::ChipBreak)),
        800 => M::CycleOff,
        810 => M::Cycle(CycleKind::Drill { dwell: false }),
        820 => M::Cycle(CycleKind::Drill { dwell: true }),
        830 => M::Cycle(CycleKind::Peck(PeckKind::Deep)),
        850 => M::Cycle(CycleKind::Bore { dwell: false }),
        890 => M::Cycle(CycleKind::Bore { dwell: true }),
        900 => M::Incremental(false),
        910 => M::Incremental(true),
        901 => M::CentreAbsolute(true),
        911 => M::CentreAbsolute(false),
        930 => M::FeedMode(FeedMode::InverseTime),
        940 => M::FeedMode(FeedMode::PerMinute),
        950 => M::FeedMode(FeedMode::PerRevolution),
        980 => M::ReturnToInitial(true),
        990 => M::ReturnToInitial(false),
        other => return Err(refused(other)),
    })
}

fn offset(tenths: u32) -> Option<WorkOffset> {
    let number = if tenths > 590 { 6 + tenths % 10 } else { tenths / 10 - 53 };
    u8::try_from(number).ok().and_then(WorkOffset::new)
}

/// Why a G code is refused.
fn refused(tenths: u32) -> &'static str {
    match tenths {
        50..=53 | 62 => {
            "G5 to G5.3 and G6.2 are splines, which are not read, or for Fanuc a mode such as G5.1 Q1; post lines and \
             arcs without the mode"
        }
        100..=109 => {
            "G10 changes the controller's tables, which are data of the request: setup, offsets and tool_length"
        }
        412 | 422 | 413 | 423 => {
            "compensation by a radius in space (G41.2) is not read; post the path of the tool centre point"
        }
        431 | 437 | 440 => {
            "this length compensation is not read; accepted are G43, G43.4 and G43.5 with H, and G49"
        }
        520 => {
            "G52 shifts the origin, which is not read; state the origin with setup or offsets in the request"
        }
        541 => "further offsets (G54.1) are not read; accepted are G54 to G59.3",
        650..=679 => "macros (G65, G66) are not read; post the program without calls",
        680 | 683 | 684 => "this rotation of coordinates is not read; accepted are G68.2 with G53.1, and G69",
        740 | 760 | 840..=849 | 860 | 870 | 880 => {
            "this cycle is not read; accepted are G73, G80 to G83, G85 and G89"
        }
        920..=929 => {
            "G92 shifts the origin, which is not read; state the origin with setup or offsets in the request"
        }
        2340 => {
            "G234 of Haas begins control of the tool centre point; state G234 in tcp_on, and G49 in tcp_off"
        }
        _ => UNKNOWN,
    }
}

/// The effect of an M code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Miscellaneous {
    Stop,
    OptionalStop,
    End,
    Spindle(Rotation),
    ToolChange,
    Coolant(Coolant),
    Call,
    Unknown,
}

/// The meaning of an M code.
pub(crate) fn miscellaneous(tenths: u32) -> Miscellaneous {
    match tenths {
        0 => Miscellaneous::Stop,
        10 => Miscellaneous::OptionalStop,
        20 | 300 => Miscellaneous::End,
        30 => Miscellaneous::Spindle(Rotation::Clockwise),
        40 => Miscellaneous::Spindle(Rotation::CounterClockwise),
        50 => Miscellaneous::Spindle(Rotation::Off),
        60 => Miscellaneous::ToolChange,
        70 => Miscellaneous::Coolant(Coolant::Mist),
        80 => Miscellaneous::Coolant(Coolant::Flood),
        90 => Miscellaneous::Coolant(Coolant::Off),
        970 | 980 | 990 => Miscellaneous::Call,
        _ => Miscellaneous::Unknown,
    }
}

impl Miscellaneous {
    /// Whether two codes in one block exclude each other.
    pub(crate) fn excludes(self, other: Self) -> bool {
        use Miscellaneous::{Coolant as C, End, OptionalStop, Spindle, Stop, ToolChange};
        match (self, other) {
            (C(first), C(second)) => first == second || first == Coolant::Off || second == Coolant::Off,
            (Stop | OptionalStop | End, Stop | OptionalStop | End)
            | (Spindle(_), Spindle(_))
            | (ToolChange, ToolChange) => true,
            _ => false,
        }
    }
}
