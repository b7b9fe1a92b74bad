//! Requests of the tests.

use verne_solver::workspace::{Kind, Request};

pub(crate) fn request(kind: Kind, tool_length: f64, phi1: f64, tolerance: f64) -> Request {
    Request { tool_length, phi1: phi1.to_radians(), ..Request::new(kind, tolerance) }
}

/// The same request with the table as a limit.
pub(crate) fn above(least: f64, tool_radius: f64, request: Request) -> Request {
    Request { table_clearance: Some(least), tool_radius, ..request }
}
