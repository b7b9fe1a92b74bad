//! A machine of the VERNE architecture: its plain data, and the checked machine made from it.

mod fault;
mod reference;
mod validate;

pub use fault::MachineFault;

use crate::axis::direction;
use crate::forward;
use crate::inverse::LITTLE;
use crate::jacobian;
use crate::margins::cone::{Columns, columns};
use crate::margins::interference;
use crate::margins::weights::Weights;

/// Least distance, mm, that scales rod interference for machines whose rods cross at home.
const SMALL_DISTANCE: f64 = 1e-3;

/// Dimensions of the parallel module, in mm, with the paper's symbols (Fig. 3, Eqs (3)-(6)).
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(non_snake_case, reason = "the paper's symbols: D1 and d1 are two dimensions")]
pub struct Geometry {
    /// x of leg I's joints on the platform, in the platform frame.
    pub D1: f64,
    /// x of leg I's guideway, in the base frame.
    pub d1: f64,
    /// x of legs II and III's joints on the platform, in the platform frame.
    pub D2: f64,
    /// x of legs II and III's guideways, in the base frame.
    pub d2: f64,
    /// Half-distance of leg I's joints on the platform.
    pub R1: f64,
    /// Half-distance of leg I's joints on the slider.
    pub r1: f64,
    /// Half-distance of legs II and III on the platform.
    pub R2: f64,
    /// Half-distance of legs II and III's guideways.
    pub r4: f64,
    /// Rod length of leg I.
    pub L1: f64,
    /// Rod length of leg II.
    pub L2: f64,
    /// Rod length of leg III.
    pub L3: f64,
    /// Half-width w of the parallelograms of legs II and III, along x.
    pub parallelogram_half_width: f64,
    /// Radius of every rod.
    pub rod_radius: f64,
}

/// The tilting table's offsets, in mm (Eq (7)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Table {
    /// z of the tilting axis in the base frame.
    pub da: f64,
    /// Offset from the tilting axis to the table's origin.
    pub dt: f64,
}

/// Limits of joints and of singularities. Angles in radians, lengths in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Range of each slider, `[min, max]`.
    pub stroke: [[f64; 2]; 3],
    /// Half-angle of the cone that each rod may use at its slider.
    pub slider_cone: f64,
    /// Half-angle of the cone that each rod may use at the platform.
    pub platform_cone: f64,
    /// Least cosine between a rod and its guideway.
    pub serial_margin: f64,
    /// Least parallel conditioning `det_P`, in the sign it has at home.
    pub parallel_margin: f64,
    /// Range of the tilting angle theta1.
    pub tilt: [f64; 2],
    /// Range of the rotary angle theta2.
    pub rotary: [f64; 2],
    /// Least height of the tool's end and of the platform's joints over the plane Z = 0 of the part frame, mm.
    /// `None`: the table is no limit unless the request gives a height. See [`crate::Clearance`].
    pub table_clearance: Option<f64>,
    /// Axes of the slider cones in the base frame, for rod 11, rod 12, leg II, leg III; any length but zero. `None`
    /// means the rods' own directions at home.
    pub slider_axes: Option<[[f64; 3]; 4]>,
    /// Axes of the platform cones in the platform frame, in the same order and direction (from slider to platform).
    /// `None` means the rods' own directions at home.
    pub platform_axes: Option<[[f64; 3]; 4]>,
}

/// Plain numbers that may or may not describe a valid machine. [`Machine::new`] checks them.
#[derive(Clone, Debug, PartialEq)]
pub struct MachineData {
    /// Short name, as used in requests.
    pub name: String,
    /// The origin of the numbers.
    pub description: String,
    /// The parallel module.
    pub geometry: Geometry,
    /// The tilting table.
    pub table: Table,
    /// The limits.
    pub limits: Limits,
}

/// A valid machine. Every value of this type has positive lengths, ordered ranges, a solvable elimination (e1 ≠ e2,
/// R1 > r1) and a home posture in the working mode away from singularity.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    data: MachineData,
    pub(crate) derived: Derived,
}

/// Constants of the formulas, derived once from the data.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Derived {
    /// e1 = D1 - d1 and e2 = D2 - d2.
    pub(crate) e1: f64,
    pub(crate) e2: f64,
    /// C = R1² + r1² and k = 2 R1 r1, so that u² + v² = C - k cos a.
    pub(crate) c: f64,
    pub(crate) k: f64,
    /// (R1 - r1)².
    pub(crate) gap_square: f64,
    /// Threshold of the square of leg I's drop, mm². Below it the drop is computed with twice the digits.
    pub(crate) little: f64,
    /// 1/L of rod 11, rod 12, leg II, leg III.
    pub(crate) inverse_lengths: [f64; 4],
    /// 1/R1².
    pub(crate) inverse_r1_square: f64,
    /// acos(r1/R1): the rods of leg I do not cross for |alpha| below it.
    pub(crate) uncrossed: f64,
    /// Largest length of the machine: the scale of tolerances.
    pub(crate) scale: f64,
    /// Unit axes of the slider cones (base frame) and platform cones (platform frame).
    pub(crate) slider_axes: Columns,
    pub(crate) platform_axes: Columns,
    /// `det_P` at home; its sign is the machine's.
    pub(crate) home_det: f64,
    /// The forward closure's determinant at home; its sign goes with `home_det`'s.
    pub(crate) home_turn: f64,
    /// Least distance between two rods' axes at home, mm: the scale of rod interference.
    pub(crate) home_distance: f64,
    /// Factors that make margins comparable.
    pub(crate) weights: Weights,
}

impl Machine {
    /// Checks the numbers and derives from them what the formulas need.
    ///
    /// # Units
    ///
    /// Lengths are millimetres, angles radians.
    ///
    /// # Errors
    ///
    /// Every fault found, each with the path of its field, such as `limits/stroke/0`. A machine needs finite numbers,
    /// positive lengths, ordered ranges, D1 - d1 different from D2 - d2, R1 greater than r1, and a home posture in the
    /// working mode away from parallel singularity.
    ///
    /// # References
    ///
    /// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(7), Fig. 3; the
    /// conditions e1 ≠ e2 and R1 ≠ r1 stem from the elimination (see the crate's documentation).
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    ///
    /// let mut data = Machine::verne().data().clone();
    /// data.geometry.L1 = -1.0;
    /// let faults = Machine::new(data).unwrap_err();
    /// assert!(faults.iter().any(|fault| fault.field == "geometry/L1"));
    /// ```
    pub fn new(data: MachineData) -> Result<Self, Vec<MachineFault>> {
        let faults = validate::faults(&data);
        if !faults.is_empty() {
            return Err(faults);
        }
        let derived = Derived::new(&data);
        let machine = Self { data, derived };
        if machine.derived.home_det.abs() < validate::LEAST_HOME_DET {
            return Err(vec![MachineFault::new("geometry", "the home pose is a parallel singularity")]);
        }
        Ok(machine)
    }

    /// The data from which the machine was made.
    ///
    /// # Units
    ///
    /// Millimetres and radians.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    ///
    /// let data = Machine::verne().data().clone();
    /// assert_eq!(Machine::new(data), Ok(Machine::verne()));
    /// ```
    pub fn data(&self) -> &MachineData {
        &self.data
    }

    /// The machine's name, as requests use it.
    ///
    /// # Examples
    ///
    /// ```
    /// assert_eq!(verne_solver::Machine::verne().name(), "verne");
    /// ```
    pub fn name(&self) -> &str {
        &self.data.name
    }

    /// The longest dimension that occurs in the equations. A length in a request may be up to
    /// [`MOST_RATIO`](crate::MOST_RATIO) times as long.
    ///
    /// # Units
    ///
    /// Millimetres.
    ///
    /// # Examples
    ///
    /// ```
    /// assert_eq!(verne_solver::Machine::verne().longest(), 1050.0, "a rod");
    /// ```
    pub fn longest(&self) -> f64 {
        self.derived.scale
    }

    pub(crate) fn geometry(&self) -> &Geometry {
        &self.data.geometry
    }

    pub(crate) fn limits(&self) -> &Limits {
        &self.data.limits
    }

    pub(crate) fn table(&self) -> &Table {
        &self.data.table
    }
}

impl Derived {
    fn new(data: &MachineData) -> Self {
        let g = &data.geometry;
        let e1 = g.D1 - g.d1;
        let e2 = g.D2 - g.d2;
        let rods = jacobian::at_home(g).rods;
        let home = rods.directions.map(unit);
        let along = |axes: [[f64; 3]; 4]| axes.map(|axis| unit(direction(axis).unwrap_or(axis)));
        let slider_axes = data.limits.slider_axes.map_or(home, along);
        let platform_axes = data.limits.platform_axes.map_or(home, along);
        let home_det = jacobian::det_at_home(g);
        let home_distance = interference::nearest(g, &rods).0.max(SMALL_DISTANCE);
        let mut derived = Self {
            e1,
            e2,
            c: g.R1 * g.R1 + g.r1 * g.r1,
            k: 2.0 * g.R1 * g.r1,
            gap_square: (g.R1 - g.r1) * (g.R1 - g.r1),
            little: LITTLE * g.L1 * g.L1,
            inverse_lengths: [1.0 / g.L1, 1.0 / g.L1, 1.0 / g.L2, 1.0 / g.L3],
            inverse_r1_square: 1.0 / (g.R1 * g.R1),
            uncrossed: (g.r1 / g.R1).acos(),
            scale: validate::longest(g),
            slider_axes: columns(&slider_axes),
            platform_axes: columns(&platform_axes),
            home_det,
            home_distance,
            weights: Weights::new(data, home_det, home_distance),
            home_turn: 0.0,
        };
        derived.home_turn = forward::turn_at_home(g, &derived);
        derived
    }
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let norm = v.iter().map(|c| c * c).sum::<f64>().sqrt();
    v.map(|c| c / norm)
}
