//! Adds API keys, and the problems of access control, to the OpenAPI document.

use utoipa::openapi::OpenApi;
use utoipa::openapi::path::{Operation, Paths};
use utoipa::openapi::security::{Http, HttpAuthScheme, SecurityRequirement, SecurityScheme};

use crate::http::access_control::Access;
use crate::http::openapi::problem_responses::add_codes;
use crate::http::problem::code::Code;
use crate::limits::admission::RequestClass;
use crate::wire::role::Role;

const BEARER: &str = "bearer";

/// Codes of operations other than monitoring.
const LIMITS: &[Code] = &[Code::TooManyRequests, Code::Overloaded];

/// The document with the scheme of API keys.
pub(crate) fn with_bearer_scheme(mut document: OpenApi) -> OpenApi {
    let mut scheme = Http::new(HttpAuthScheme::Bearer);
    scheme.description =
        Some("An API key. The service requires it if it was started with --keys.".to_owned());
    let components = document.components.get_or_insert_default();
    components.add_security_scheme(BEARER, SecurityScheme::Http(scheme));
    document
}

/// The operations of a route with the codes that its access control returns.
pub(crate) fn with_access_problems(mut paths: Paths, access: Access) -> Paths {
    for item in paths.paths.values_mut() {
        for operation in [&mut item.get, &mut item.post, &mut item.delete].into_iter().flatten() {
            match access {
                Access::Probe => {
                    operation.security = Some(Vec::new());
                    continue;
                }
                Access::Open => {
                    operation.security = Some(Vec::new());
                    add_codes(&mut operation.responses.responses, LIMITS);
                }
                Access::Key(role, class) => require_key(operation, role, class),
            }
            add_codes(&mut operation.responses.responses, &[Code::HostNotAllowed]);
        }
        for operation in [&mut item.post, &mut item.delete].into_iter().flatten() {
            add_codes(&mut operation.responses.responses, &[Code::OtherOrigin]);
        }
    }
    paths
}

fn require_key(operation: &mut Operation, role: Role, class: RequestClass) {
    // The second requirement, none, applies to a service without keys.
    let requirements = [SecurityRequirement::new(BEARER, [""; 0]), SecurityRequirement::default()];
    operation.security = Some(requirements.into());
    let responses = &mut operation.responses.responses;
    // Requests with unknown keys count against the address that sends them.
    add_codes(responses, &[Code::Unauthorized, Code::TooManyRequests]);
    if class != RequestClass::Monitoring {
        add_codes(responses, LIMITS);
    }
    if role > Role::Read {
        add_codes(responses, &[Code::Forbidden, Code::OtherOrigin]);
    }
}
