//! From typed questions to typed answers: what handlers and the command line share.

mod batch_rows;
mod contains;
mod dexterity;
mod dexterity_question;
mod family;
mod family_question;
mod forward;
mod forward_batch;
mod inverse;
mod inverse_batch;
mod mesh_files;
mod near;
mod orientation;
mod question;
mod slice;
mod solutions;
mod stage;
mod workspace;
mod workspace_colours;
mod workspace_question;

pub(crate) use contains::answer_contains;
pub(crate) use dexterity::compute_dexterity;
pub(crate) use dexterity_question::DexterityQuestion;
pub(crate) use family::FamilyTable;
pub(crate) use family_question::FamilyQuestion;
pub(crate) use forward::answer_fk;
pub(crate) use forward_batch::answer_fk_batch;
pub(crate) use inverse::answer_ik;
pub(crate) use inverse_batch::answer_ik_batch;
pub(crate) use mesh_files::{Described, write_mesh};
pub(crate) use question::{Gist, Question, TaskFault};
pub(crate) use slice::answer_slice;
pub(crate) use stage::part_of;
pub(crate) use workspace::compute_workspace;
pub(crate) use workspace_question::WorkspaceQuestion;
