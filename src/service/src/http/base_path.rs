//! Serves the API below a path of a proxy. The proxy may keep the path in the requests or remove it.

use axum::Router;
use axum::extract::Request;
use axum::http::header::{CONTENT_LOCATION, LOCATION};
use axum::http::uri::PathAndQuery;
use axum::http::{HeaderValue, Response, Uri};
use axum::response::Redirect;
use axum::routing::get;
use tower::ServiceBuilder;

use crate::http::proxy::BasePath;

/// Adds a redirect from the base path to the page below it. Without the slash at its end the page would look for its
/// files beside the base path.
pub(crate) fn with_redirect<S: Clone + Send + Sync + 'static>(
    routes: Router<S>,
    base: &BasePath,
) -> Router<S> {
    if base.as_str().is_empty() {
        return routes;
    }
    routes.route(base.as_str(), get(async || Redirect::permanent("/")))
}

/// The routes below the base path. The headers of the responses begin with it.
pub(crate) fn nest(routes: Router, base: &BasePath) -> Router {
    if base.as_str().is_empty() {
        return routes;
    }
    let (of_requests, of_responses) = (base.clone(), base.clone());
    // The layers of a router run after it has chosen the route.
    Router::new().fallback_service(
        ServiceBuilder::new()
            .map_request(move |request| remove_from_uri(&of_requests, request))
            .map_response(move |response| add_to_headers(&of_responses, response))
            .service(routes),
    )
}

/// A summary with links that begin with the base path; `None` without one. All links are below the path of the
/// result, which occurs nowhere else.
pub(crate) fn summary_below(base: &BasePath, summary: &[u8], path: &str) -> Option<Vec<u8>> {
    if base.as_str().is_empty() {
        return None;
    }
    let link = format!("\"{path}");
    let text = std::str::from_utf8(summary).ok()?;
    Some(text.replace(&link, &format!("\"{base}{path}")).into_bytes())
}

fn remove_from_uri(base: &BasePath, mut request: Request) -> Request {
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

fn add_to_headers<B>(base: &BasePath, mut response: Response<B>) -> Response<B> {
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
