//! Programs given as rows: a tip, an orientation, and optionally a feed, a kind and a line.

pub(crate) mod csv;
pub(crate) mod ndjson;
pub(crate) mod points;
pub(crate) mod row;
mod row_builder;
pub(crate) mod table;
