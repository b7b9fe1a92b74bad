//! G-code: RS-274/NGC and Fanuc, with control of the tool centre point.
//!
//! [`lexer`] cuts a line into words, [`codes`] finds the G and M codes of a block and their conflicts, [`dispatch`]
//! does what a block says in the order in which controllers do it.

mod auxiliary;
mod block;
mod circle;
mod codes;
mod coordinates;
mod cycle;
mod dispatch;
mod feed;
mod hole;
mod home;
mod length;
mod lexer;
mod motion;
mod position;
mod reader;
mod state;
mod text;
mod tilt;
mod tilted_plane;
mod tool_axis;
mod turn;
mod vocabulary;

pub(crate) use reader::GcodeReader;
