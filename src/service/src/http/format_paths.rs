//! A path of its own for each format of a file or table: `/workspace/{id}/mesh.glb`, `/ik/batch.csv`.
//!
//! Clients that are generated from the OpenAPI document know one media type of each body. The document therefore
//! lists these paths. The path without a format selects it by `format`, Accept or Content-Type. The document lists it
//! only for requests with a body, where it is that of JSON.

use axum::extract::Request;
use axum::http::Uri;
use axum::http::uri::PathAndQuery;
use axum::routing::MethodRouter;
use tower::util::MapRequestLayer;
use utoipa::openapi::path::{Operation, PathItem, Paths};
use utoipa::openapi::{RefOr, Response};
use verne_rows::Format;

use crate::http::state::SharedState;
use crate::wire::format::{MeshFormat, SliceFormat};
use crate::wire::row_format::RowFormat;

/// The name and the media type of a format.
type NameAndMedia = (&'static str, &'static str);

/// The formats that have paths of their own: of the file at a path, or those besides JSON of a path that is listed for
/// JSON.
fn formats(path: &str) -> Vec<NameAndMedia> {
    match path {
        "/workspace/{id}/mesh" | "/toolpath/{id}/mesh" => {
            MeshFormat::ALL.map(|format| (format.name(), format.media())).into()
        }
        "/workspace/{id}/slice" | "/toolpath/{id}/slice" => {
            SliceFormat::ALL.map(|format| (format.name(), format.media()[0])).into()
        }
        "/atlas" => {
            [SliceFormat::Svg, SliceFormat::Dxf].map(|format| (format.name(), format.media()[0])).into()
        }
        "/toolpath/{id}/rows" | "/workspace/{id}/cells" => {
            RowFormat::ALL.map(|format| (format.name(), format.media())).into()
        }
        "/fk/batch" | "/ik/batch" | "/error-budget" | "/machines/calibration" | "/workspace/contains" => {
            Format::ALL.map(|format| (format.name(), format.media())).into()
        }
        _ => Vec::new(),
    }
}

/// The routes of the formats of a route, each with its documentation; none if it has one format.
pub(crate) fn of(
    paths: &Paths,
    route: &MethodRouter<SharedState>,
) -> Vec<(Paths, MethodRouter<SharedState>)> {
    let of_path = |(path, item): (&String, &PathItem)| {
        let of_format = |format: NameAndMedia| {
            let (name, _) = format;
            let mut paths = Paths::new();
            paths.paths.insert(format!("{path}.{name}"), in_format(item.clone(), format));
            let with_format = MapRequestLayer::new(move |request| with_format(request, name));
            (paths, route.clone().layer(with_format))
        };
        formats(path).into_iter().map(of_format).collect::<Vec<_>>()
    };
    paths.paths.iter().flat_map(of_path).collect()
}

/// The documentation of a path for one of its formats.
fn in_format(mut item: PathItem, format: NameAndMedia) -> PathItem {
    for operation in [&mut item.get, &mut item.post].into_iter().flatten() {
        narrow(operation, format);
    }
    item
}

/// Whether the document lists the path without a format, too.
pub(crate) fn is_listed(paths: &Paths) -> bool {
    paths.paths.iter().all(|(path, item)| formats(path).is_empty() || item.post.is_some())
}

fn narrow(operation: &mut Operation, (name, media): NameAndMedia) {
    if let Some(id) = &mut operation.operation_id {
        *id = format!("{id}_{name}");
    }
    if let Some(summary) = &mut operation.summary {
        *summary = format!("{summary}, as {}", name.to_ascii_uppercase());
    }
    if let Some(parameters) = &mut operation.parameters {
        parameters.retain(|parameter| !matches!(parameter, RefOr::T(known) if known.name == "format"));
    }
    // The body of a request for a drawing is JSON.
    if let Some(RefOr::T(body)) = &mut operation.request_body
        && body.content.contains_key(media)
    {
        body.content.retain(|known, _| known == media);
    }
    if let Some(RefOr::T(Response { content, .. })) = operation.responses.responses.get_mut("200")
        // The answer to a table may be a JSON document.
        && content.contains_key(media)
    {
        content.retain(|known, _| known == media);
    }
}

/// The request with the format of its path as a parameter.
fn with_format(mut request: Request, name: &str) -> Request {
    let uri = request.uri();
    let query = uri.query().map(|query| format!("{query}&")).unwrap_or_default();
    let target = format!("{}?{query}format={name}", uri.path());
    let mut parts = uri.clone().into_parts();
    // Every text of a path and a query that was read can be read with one more parameter.
    if let Ok(target) = PathAndQuery::try_from(target) {
        parts.path_and_query = Some(target);
        if let Ok(uri) = Uri::from_parts(parts) {
            *request.uri_mut() = uri;
        }
    }
    request
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use axum::body::{Body, Bytes};
    use axum::http::header::{ACCEPT, CONTENT_TYPE};
    use axum::http::{HeaderMap, Request, StatusCode};
    use serde_json::{Value, json};

    use crate::process::service::Service;
    use crate::test_service::{send, service};

    async fn get(service: &Service, path: &str, accept: &str) -> (StatusCode, HeaderMap, Bytes) {
        let request = Request::get(path).header(ACCEPT, accept).body(Body::empty());
        send(service, request.unwrap()).await
    }

    #[tokio::test]
    async fn a_path_with_a_format_answers_as_the_parameter_does() {
        let service = service("").await;
        let question = Request::post("/workspace").header(CONTENT_TYPE, "application/json");
        let body = json!({"kind": "part", "tool_length": 50, "tolerance": 50}).to_string();
        let (_, _, summary) = send(&service, question.body(body.into()).unwrap()).await;
        let summary: Value = serde_json::from_slice(&summary).unwrap();
        let path = format!("/workspace/{}", summary["id"].as_str().unwrap());
        for (file, query, formats) in [
            ("mesh", "", ["glb", "stl", "ply", "json"].as_slice()),
            ("slice", "z=200", ["json", "svg", "dxf"].as_slice()),
        ] {
            for format in formats {
                // The path decides, whatever a generated client accepts.
                let of_path =
                    get(&service, &format!("{path}/{file}.{format}?{query}"), "application/json").await;
                let of_query = get(&service, &format!("{path}/{file}?format={format}&{query}"), "*/*").await;
                assert_eq!(of_path.0, StatusCode::OK, "{file}.{format}: {:?}", of_path.2);
                assert_eq!(of_path.1[CONTENT_TYPE], of_query.1[CONTENT_TYPE]);
                assert!(of_path.2 == of_query.2, "{file}.{format}");
            }
        }
        let (status, _, _) = get(&service, &format!("{path}/mesh.glb?format=stl"), "*/*").await;
        assert_eq!(status, StatusCode::UNPROCESSABLE_ENTITY);
        assert_eq!(get(&service, &format!("{path}/mesh.obj"), "*/*").await.0, StatusCode::NOT_FOUND);
    }

    #[tokio::test]
    async fn tables_have_paths_besides_that_of_json() {
        let service = service("").await;
        let rows = "x,y,z,phi1,phi2\n100,50,300,0,0\n";
        let post = |path: &str, media: &str, body: String| {
            Request::post(path).header(CONTENT_TYPE, media).body(Body::from(body)).unwrap()
        };
        let path = "/ik/batch.csv?tool_length=50";
        let (status, _, of_path) = send(&service, post(path, "text/csv", rows.to_owned())).await;
        assert_eq!(status, StatusCode::OK, "{of_path:?}");
        let path = "/ik/batch?tool_length=50&format=csv";
        assert_eq!(send(&service, post(path, "text/csv", rows.to_owned())).await.2, of_path);
        let body = json!({"poses": [[100, 50, 300, 0, 0]]}).to_string();
        let (status, _, answer) = send(&service, post("/ik/batch", "application/json", body)).await;
        assert_eq!(status, StatusCode::OK, "{answer:?}");
    }
}
