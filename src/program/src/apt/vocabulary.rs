//! The words of CL text.

/// A word whose statement is a text, with or without a slash.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TextWord {
    /// PARTNO: the name of the part.
    PartNumber,
    /// A text for the operator, or a comment.
    Comment,
    /// INSERT: a text for the controller.
    Insert,
}

/// A word that begins a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Word {
    Goto,
    Godlta,
    From,
    GoHome,
    Rapid,
    Feedrate,
    Spindle,
    Units,
    LoadTool,
    Load,
    ToolAxis,
    MultiAxis,
    MoveArc,
    Circle,
    Cycle,
    Coolant,
    Delay,
    Stop,
    OptionalStop,
    End,
    Fini,
    ToolPath,
    EndOfPath,
    CutterCompensation,
    CoordinateSystem,
    TransformationType,
    MachineSystem,
    Direction,
    PartSurface,
    AutomaticPartSurface,
    ToolOn,
    /// Moves the origin, unless all its numbers are zero.
    Shift,
    /// Passed on: it concerns the controller and does not move the tool.
    PassedOn,
    /// Neither moves the tool nor concerns the controller.
    Silent,
    /// Moves the tool, and cannot be read. The text says what to write instead.
    Moving(&'static str),
    Unknown,
}

const TEXT_WORDS: [(&str, TextWord); 16] = [
    ("PARTNO", TextWord::PartNumber),
    ("INSERT", TextWord::Insert),
    ("REMARK", TextWord::Comment),
    ("PPRINT", TextWord::Comment),
    ("TPRINT", TextWord::Comment),
    ("PPWORD", TextWord::Comment),
    ("DISPLY", TextWord::Comment),
    ("CATPROCESS", TextWord::Comment),
    ("CATPRODUCT", TextWord::Comment),
    ("MACHINE", TextWord::Comment),
    ("OP_NAME", TextWord::Comment),
    ("PART_OPE", TextWord::Comment),
    ("PROGRAM", TextWord::Comment),
    ("OPERATION", TextWord::Comment),
    ("TITLES", TextWord::Comment),
    ("LETTER", TextWord::Comment),
];

/// The word and the text of a line that is a text. It may stand in quotes.
pub(crate) fn text_word(line: &str) -> Option<(TextWord, &str)> {
    let end = line.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(line.len());
    // Most lines are motions; none of their words is that long.
    let (word, rest) = line.split_at(end);
    let (_, kind) = TEXT_WORDS.iter().find(|(known, _)| known.eq_ignore_ascii_case(word))?;
    let text = rest.trim_start();
    let text = text.strip_prefix('/').unwrap_or(text).trim();
    let quoted = text.strip_prefix('\'').and_then(|text| text.strip_suffix('\''));
    Some((*kind, quoted.unwrap_or(text)))
}

const WRITE_GOTO: &str = "this word moves the tool along geometry; post the path as GOTO and CIRCLE";
const STATE_AXIS: &str =
    "this word turns the tool or the table by itself; state the axis in GOTO/x,y,z,i,j,k";
const TRANSFORM: &str = "this word transforms or repeats points; post the path without it";
const CYCLES: &str = "this word moves the tool in a way that is not read; post it as GOTO, CIRCLE or CYCLE";

impl Word {
    /// The word of a statement, in capitals.
    pub(crate) fn of(word: &str) -> Self {
        match word {
            "GOTO" => Self::Goto,
            "GODLTA" => Self::Godlta,
            "FROM" => Self::From,
            "GOHOME" => Self::GoHome,
            "RAPID" => Self::Rapid,
            "FEDRAT" => Self::Feedrate,
            "SPINDL" => Self::Spindle,
            "UNITS" | "UNIT" => Self::Units,
            "LOADTL" => Self::LoadTool,
            "LOAD" => Self::Load,
            "TLAXIS" => Self::ToolAxis,
            "MULTAX" => Self::MultiAxis,
            "MOVARC" => Self::MoveArc,
            "CIRCLE" => Self::Circle,
            "CYCLE" => Self::Cycle,
            "COOLNT" => Self::Coolant,
            "DELAY" => Self::Delay,
            "STOP" => Self::Stop,
            "OPSTOP" => Self::OptionalStop,
            "END" => Self::End,
            "FINI" => Self::Fini,
            "TOOL" => Self::ToolPath,
            "END-OF-PATH" => Self::EndOfPath,
            "CUTCOM" => Self::CutterCompensation,
            "CSYS" => Self::CoordinateSystem,
            "TRNTYP" => Self::TransformationType,
            "MSYS" => Self::MachineSystem,
            "INDIRV" => Self::Direction,
            "PSIS" => Self::PartSurface,
            "AUTPS" | "AUTOPS" => Self::AutomaticPartSurface,
            "TLON" => Self::ToolOn,
            "ORIGIN" | "TRANS" => Self::Shift,
            _ => Self::of_others(word),
        }
    }

    fn of_others(word: &str) -> Self {
        match word {
            "AUXFUN" | "BREAK" | "CLAMP" | "OPNAME" | "OPSKIP" | "PPFUN" | "SEQNO" | "SLOWDN" | "TMARK"
            | "UNLOAD" => Self::PassedOn,
            "ARCSLP"
            | "CAMERA"
            | "CHANNEL"
            | "CLPRNT"
            | "CUTTER"
            | "FEATNO"
            | "INTOL"
            | "LEADER"
            | "LINTOL"
            | "MACHIN"
            | "MCHTOL"
            | "MODE"
            | "NOPOST"
            | "OFSTNO"
            | "OPERNO"
            | "OUTTOL"
            | "PAINT"
            | "PROGNO"
            | "REWIND"
            | "SELECT"
            | "TDATA"
            | "TLDATA"
            | "TOLER"
            | "TOOLNO"
            | "CLRSRF"
            | "CSI_SET_FLUTE_LENGTH"
            | "CSI_SET_EXTENSION_LENGTH" => Self::Silent,
            "GO" | "GOLFT" | "GORGT" | "GOFWD" | "GOBACK" | "GOUP" | "GODOWN" | "INDIRP" | "TLLFT"
            | "TLRGT" | "TLONPS" | "TLOFPS" | "POCKET" | "PROFIL" | "SURFPT" | "CONTACT" | "DNTCUT" => {
                Self::Moving(WRITE_GOTO)
            }
            "ROTABL" | "ROTATE" | "ROTHED" | "ROTREF" | "TILT" | "POSITN" => Self::Moving(STATE_AXIS),
            "COPY" | "INDEX" | "TRACUT" | "REFSYS" | "MATRIX" | "MACRO" | "CALL" | "CALSUB" | "LOOPST"
            | "LOOPND" | "JUMPTO" | "IF" | "DO" | "MIRROR" | "SCALE" => Self::Moving(TRANSFORM),
            "RETRCT" | "THREAD" | "PREFUN" | "SAFPOS" => Self::Moving(CYCLES),
            "SPLINE" | "BSPLIN" | "NURBS" | "POLYNM" => {
                Self::Moving("splines are not read; post the path with linear output")
            }
            _ => Self::Unknown,
        }
    }
}
