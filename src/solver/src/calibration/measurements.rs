//! What was measured.

use super::CalibrationError;
use super::unknown::Unknown;
use crate::parameter::{MACHINE_FRAME_PARAMETERS, Parameter, ToolFrame};
use crate::pose::{Point, TableAngles};

/// Measurements at positions of the sliders.
///
/// # Units
///
/// Millimetres and radians.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurements {
    /// The sliders' positions that the control indicated, for each pose.
    pub rho: Vec<[f64; 3]>,
    /// What was measured there.
    pub observed: Observed,
}

/// What was measured.
#[derive(Clone, Debug, PartialEq)]
pub enum Observed {
    /// The tool's end in the base frame, at each pose.
    Tips(Vec<Point>),
    /// The tool's end in a frame of the measuring device that stands still, at each pose. Where this frame is follows
    /// from the measurements, too.
    TrackerTips(Vec<Point>),
    /// The tool's end in the part frame, at each pose.
    PartTips(Vec<PartTip>),
    /// Distances between the tool's ends of two poses.
    Distances(Vec<TipDistance>),
    /// The distance of the tool's end from a ball that stands still, at each pose.
    BallBar {
        /// The ball's centre in the base frame. `None`: it follows from the measurements, too.
        centre: Option<Point>,
        /// The distances.
        lengths: Vec<f64>,
    },
}

/// The tool's end in the part frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartTip {
    /// The table's angles that the control indicated.
    pub table: TableAngles,
    /// The tool's end.
    pub tip: Point,
}

/// The distance between the tool's ends of two poses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipDistance {
    /// The two poses, as indices of [`Measurements::rho`].
    pub poses: [usize; 2],
    /// The distance.
    pub length: f64,
}

impl Measurements {
    /// The number of measurements.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::calibration::{Measurements, Observed, TipDistance};
    ///
    /// let observed = Observed::Distances(vec![TipDistance { poses: [0, 1], length: 141.4 }]);
    /// let measurements = Measurements { rho: vec![[600.0, 500.0, 500.0], [650.0, 480.0, 520.0]], observed };
    /// assert_eq!(measurements.count(), 1);
    /// ```
    pub fn count(&self) -> usize {
        match &self.observed {
            Observed::Tips(tips) | Observed::TrackerTips(tips) => tips.len(),
            Observed::PartTips(tips) => tips.len(),
            Observed::Distances(distances) => distances.len(),
            Observed::BallBar { lengths, .. } => lengths.len(),
        }
    }

    /// The frame in which the tool's end at a pose is needed.
    pub(super) fn tool_frame(&self, pose: usize) -> ToolFrame {
        match &self.observed {
            Observed::PartTips(tips) => ToolFrame::Part(tips[pose].table),
            _ => ToolFrame::Machine,
        }
    }

    /// Refuses lists that do not fit together.
    pub(super) fn check(&self) -> Result<(), CalibrationError> {
        let poses = self.rho.len();
        if self.count() == 0 {
            return Err(CalibrationError::Inconsistent("there is no measurement"));
        }
        match &self.observed {
            Observed::Distances(distances) => {
                let holds = |[a, b]: [usize; 2]| a < poses && b < poses && a != b;
                if !distances.iter().all(|distance| holds(distance.poses)) {
                    return Err(CalibrationError::Inconsistent("a distance is not between two of the poses"));
                }
            }
            _ if self.count() != poses => {
                return Err(CalibrationError::Inconsistent("the poses need one measurement each"));
            }
            _ => {}
        }
        Ok(())
    }
}

impl Observed {
    /// The numbers of a measurement: x, y and z, or one length.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::calibration::Observed;
    ///
    /// assert_eq!(Observed::Tips(Vec::new()).components(), 3);
    /// assert_eq!(Observed::Distances(Vec::new()).components(), 1);
    /// ```
    pub fn components(&self) -> usize {
        match self {
            Self::Tips(_) | Self::TrackerTips(_) | Self::PartTips(_) => 3,
            Self::Distances(_) | Self::BallBar { .. } => 1,
        }
    }

    /// The parameters that influence the measurements.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::calibration::Observed;
    /// use verne_solver::parameter::Parameter;
    ///
    /// assert!(!Observed::Tips(Vec::new()).parameters().contains(&Parameter::da));
    /// assert!(Observed::PartTips(Vec::new()).parameters().contains(&Parameter::da));
    /// ```
    pub fn parameters(&self) -> &'static [Parameter] {
        match self {
            Self::PartTips(_) => &Parameter::ALL,
            _ => &Parameter::ALL[..MACHINE_FRAME_PARAMETERS],
        }
    }

    /// The unknowns beside the machine's parameters.
    pub(super) fn placement(&self) -> &'static [Unknown] {
        match self {
            Self::TrackerTips(_) => &Unknown::FRAME,
            Self::BallBar { centre: None, .. } => &Unknown::CENTRE,
            _ => &[],
        }
    }
}
