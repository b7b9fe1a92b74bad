//! CL text: the cutter location files of CAM systems, in the words of APT (ISO 4343).
//!
//! [`assembler`] joins physical lines to statements, [`lexer`] cuts them into tokens, [`dispatch`] knows the words.

mod assembler;
mod auxiliary;
mod circle;
mod cycle;
mod dispatch;
mod exit_line;
mod feed;
mod frame;
mod hole;
mod lexer;
mod motion;
mod reader;
mod state;
mod statement;
mod vocabulary;

pub(crate) use reader::AptReader;
