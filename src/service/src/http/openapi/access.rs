//! What keys mean for the document.

use utoipa::openapi::OpenApi;
use utoipa::openapi::path::{Operation, Paths};
use utoipa::openapi::security::{Http, HttpAuthScheme, SecurityRequirement, SecurityScheme};

use crate::http::gate::Access;
use crate::http::openapi::problems::document;
use crate::http::problem::code::Code;
use crate::limits::admission::Load;
use crate::wire::role::Role;

const BEARER: &str = "bearer";

/// Failures of what is not for watching the service.
const LIMITS: &[Code] = &[Code::TooManyRequests, Code::Overloaded];

/// The document with the scheme by which keys are sent.
pub(crate) fn with_scheme(mut document: OpenApi) -> OpenApi {
    let mut scheme = Http::new(HttpAuthScheme::Bearer);
    scheme.description =
        Some("An API key. The service requires it if it was started with --keys.".to_owned());
    let components = document.components.get_or_insert_default();
    components.add_security_scheme(BEARER, SecurityScheme::Http(scheme));
    document
}

/// The operations of a route with what its access adds to them.
pub(crate) fn documented(mut paths: Paths, access: Access) -> Paths {
    for item in paths.paths.values_mut() {
        for operation in [&mut item.get, &mut item.post, &mut item.delete].into_iter().flatten() {
            match access {
                Access::Probe => continue,
                Access::Open => document(&mut operation.responses.responses, LIMITS),
                Access::For(role, load) => ask_for_key(operation, role, load),
            }
            document(&mut operation.responses.responses, &[Code::HostNotAllowed]);
        }
        for operation in [&mut item.post, &mut item.delete].into_iter().flatten() {
            document(&mut operation.responses.responses, &[Code::OtherOrigin]);
        }
    }
    paths
}

fn ask_for_key(operation: &mut Operation, role: Role, load: Load) {
    // The second: not where the service has no keys.
    let either = [SecurityRequirement::new(BEARER, [""; 0]), SecurityRequirement::default()];
    operation.security = Some(either.into());
    let responses = &mut operation.responses.responses;
    // Requests with unknown keys count against the address that sends them.
    document(responses, &[Code::Unauthorized, Code::TooManyRequests]);
    if load != Load::Watch {
        document(responses, LIMITS);
    }
    if role > Role::Read {
        document(responses, &[Code::Forbidden, Code::OtherOrigin]);
    }
}
