//! Slices and atlases as drawings. Both formats show x, or u, to the right and y, or v, up, mm.

pub(crate) mod atlas;
mod dxf;
mod extent;
pub(crate) mod slice;
mod svg;
