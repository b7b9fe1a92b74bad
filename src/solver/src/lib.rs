//! Kinematics of the VERNE machine's architecture.

pub mod axis;
mod circle;
mod closure;
mod forward;
mod inverse;
pub mod jacobian;
mod limit;
pub mod machine;
mod margins;
mod pose;
mod posture;
mod residual;
mod rods;
mod table;
pub mod workspace;

pub use forward::{forward, forward_working};
pub use inverse::{part, part_working, platform, platform_working, tool, tool_working};
pub use limit::{Constraint, DOMAIN, Element, Margin, Refusal};
pub use machine::{Machine, MachineData, MachineFault};
pub use margins::Margins;
pub use pose::{PartPose, PlatformPose, Point, TableAngles};
pub use posture::{MOST, Mode, Posture, Postures, Side};
pub use residual::RESIDUAL_TOLERANCE;
pub use table::{part_pose, table_angles, tool_point};
