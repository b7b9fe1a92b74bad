//! Tests only: see `it`.
