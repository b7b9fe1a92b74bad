//! Slices as drawings. Both formats show x to the right and y up, mm.

pub(crate) mod dxf;
pub(crate) mod extent;
pub(crate) mod svg;
