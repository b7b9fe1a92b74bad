//! From typed questions to typed answers: what handlers and the command line share.

mod batch_rows;
mod forward;
mod forward_batch;
mod inverse;
mod inverse_batch;
mod near;
mod orientation;
mod solutions;

pub(crate) use forward::answer_fk;
pub(crate) use forward_batch::answer_fk_batch;
pub(crate) use inverse::answer_ik;
pub(crate) use inverse_batch::answer_ik_batch;
