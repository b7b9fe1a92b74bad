//! The service under a path of a proxy's: requests with that path or without it, and links that begin with it.

use axum::Router;
use axum::extract::Request;
use axum::http::header::{CONTENT_LOCATION, LOCATION};
use axum::http::uri::PathAndQuery;
use axum::http::{HeaderValue, Response, Uri};
use axum::response::Redirect;
use axum::routing::get;
use tower::ServiceBuilder;

use crate::http::proxy::BasePath;
use crate::wire::result_id::ResultId;

/// The routes with the path itself, which leads to the page below it.
pub(crate) fn with_page<S: Clone + Send + Sync + 'static>(routes: Router<S>, base: &BasePath) -> Router<S> {
    if base.as_str().is_empty() {
        return routes;
    }
    // Without the slash at its end the page would look for its files beside the path.
    routes.route(base.as_str(), get(async || Redirect::permanent("/")))
}

/// The service, which answers below the path and says so in its headers.
pub(crate) fn under(service: Router, base: &BasePath) -> Router {
    if base.as_str().is_empty() {
        return service;
    }
    let (of_requests, of_answers) = (base.clone(), base.clone());
    // Layers of a router come after its choice of a route.
    Router::new().fallback_service(
        ServiceBuilder::new()
            .map_request(move |request| without(&of_requests, request))
            .map_response(move |response| told(&of_answers, response))
            .service(service),
    )
}

/// A summary's bytes with links that begin with the path. Its links are those below its id, which stands nowhere else.
pub(crate) fn linked(summary: &[u8], id: ResultId, base: &BasePath) -> Option<Vec<u8>> {
    if base.as_str().is_empty() {
        return None;
    }
    let link = format!("\"{}", id.path());
    let text = std::str::from_utf8(summary).ok()?;
    Some(text.replace(&link, &format!("\"{base}{}", id.path())).into_bytes())
}

fn without(base: &BasePath, mut request: Request) -> Request {
    let uri = request.uri();
    let rest = uri.path_and_query().and_then(|whole| whole.as_str().strip_prefix(base.as_str()));
    let Some(Ok(rest)) = rest.filter(|rest| rest.starts_with('/')).map(str::parse::<PathAndQuery>) else {
        return request;
    };
    let mut parts = uri.clone().into_parts();
    parts.path_and_query = Some(rest);
    if let Ok(uri) = Uri::from_parts(parts) {
        *request.uri_mut() = uri;
    }
    request
}

fn told<B>(base: &BasePath, mut response: Response<B>) -> Response<B> {
    for name in [LOCATION, CONTENT_LOCATION] {
        let headers = response.headers_mut();
        let path =
            headers.get(&name).and_then(|path| path.to_str().ok()).filter(|path| path.starts_with('/'));
        if let Some(path) = path.and_then(|path| HeaderValue::from_str(&format!("{base}{path}")).ok()) {
            headers.insert(name, path);
        }
    }
    response
}
