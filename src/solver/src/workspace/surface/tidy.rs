//! Contraction of edges too short for single precision.

use super::Surface;

pub(super) fn contract(_surface: &mut Surface, _tolerance: f64) {}
