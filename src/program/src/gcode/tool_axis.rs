//! The tool's axis: words A or B with C, or a vector.

use std::f64::consts::FRAC_PI_2;

use crate::options::RotarySense;
use crate::orientation::Orientation;

/// The largest angle in degrees, as for every format.
pub(crate) const LARGEST: f64 = 1e6;

/// The letter of the words that tilt the tool. A program has one of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TiltLetter {
    A,
    B,
}

/// The tool's axis.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ToolAxis {
    /// Once the program has stated A or B.
    pub(crate) letter: Option<TiltLetter>,
    /// A or B, and C, in degrees as the program counts them; none if a vector was stated after them.
    tilt: Angle,
    turn: Angle,
    /// The axis in the program's frame, a unit vector, if that was stated last.
    vector: Option<[f64; 3]>,
}

/// An angle in degrees that may not be known.
#[derive(Clone, Copy, Debug)]
struct Angle(Option<f64>);

impl Default for Angle {
    fn default() -> Self {
        Self(Some(0.0))
    }
}

impl ToolAxis {
    /// A or B, in degrees.
    pub(crate) fn tilt(&self) -> Option<f64> {
        self.tilt.0
    }

    /// C in degrees.
    pub(crate) fn turn(&self) -> Option<f64> {
        self.turn.0
    }

    /// The axis is what words say.
    pub(crate) fn set_words(&mut self, tilt: f64, turn: f64) {
        self.tilt = Angle(Some(tilt));
        self.turn = Angle(Some(turn));
        self.vector = None;
    }

    /// The axis is a unit vector. The words are not known then.
    pub(crate) fn set_vector(&mut self, axis: [f64; 3]) {
        self.tilt = Angle(None);
        self.turn = Angle(None);
        self.vector = Some(axis);
    }

    /// The orientation of the tool.
    pub(crate) fn orientation(&self, sense: RotarySense) -> Orientation {
        if let Some(axis) = self.vector {
            return Orientation::Vector(axis);
        }
        let sign = match sense {
            RotarySense::Tool => 1.0,
            RotarySense::Table => -1.0,
        };
        // Adding zero turns -0.0 into 0.0.
        let radians = |angle: Angle| (sign * angle.0.unwrap_or(0.0)).to_radians() + 0.0;
        let (phi1, turn) = (radians(self.tilt), radians(self.turn));
        // Rot(z, C) Rot(y, B) z is Rot(z, C + 90 degrees) Rot(x, B) z.
        let phi2 = if self.letter == Some(TiltLetter::B) { turn + FRAC_PI_2 } else { turn };
        Orientation::Rotary { phi1, phi2 }
    }

    /// Whether the part and the tool are not turned, so that points need no control of the tool centre point.
    pub(crate) fn is_upright(&self) -> bool {
        match self.vector {
            Some(axis) => axis == [0.0, 0.0, 1.0],
            None => self.tilt.0 == Some(0.0) && self.turn.0.is_some_and(|turn| turn % 360.0 == 0.0),
        }
    }
}
