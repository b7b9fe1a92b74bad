//! Arbitrary queries, bodies, machines and headers to every operation of the service.

use std::sync::LazyLock;

use axum::body::Body;
use axum::http::{HeaderName, HeaderValue, Method, Request, Uri};
use serde_json::{Value, json};

use crate::client::{Client, post, with_client};
use crate::draw::Draw;
use crate::json::{spoilt, text};

/// Operations with a query, and its parameters. `{}` stands for an id.
const QUERIES: [(&str, &[&str]); 14] = [
    ("/fk", &["rho", "machine", "theta1", "theta2", "tool_length", "solutions", "near_joints", "near_pose"]),
    (
        "/ik",
        &[
            "x",
            "y",
            "z",
            "frame",
            "phi1",
            "phi2",
            "axis",
            "tool_length",
            "solutions",
            "machine",
            "near_joints",
            "near_pose",
        ],
    ),
    ("/workspace", &["kind", "machine", "tool_length", "phi1", "phi2", "tolerance", "format"]),
    ("/workspace/{}", &["format"]),
    ("/workspace/{}/mesh", &["format", "set"]),
    ("/workspace/{}/slice", &["z", "alpha", "format"]),
    ("/workspace/{}/cells", &["x"]),
    ("/jobs", &["state", "limit", "after"]),
    ("/jobs/{}", &["x"]),
    ("/machines", &["x"]),
    ("/machines/{}", &["x"]),
    ("/livez", &["x"]),
    ("/docs/{}", &["x"]),
    ("/{}", &["x"]),
];

/// Operations with a body, and a valid body.
static BODIES: LazyLock<[(&str, Value); 9]> = LazyLock::new(|| {
    let near = json!({"rho": [600, 600, 300]});
    [
        (
            "/fk",
            json!({"machine": "verne", "joints": {"rho": [674, 685, 250], "theta1": 0, "theta2": 0}, "tool_length": 50,
            "solutions": "all", "near": near}),
        ),
        (
            "/ik",
            json!({"machine": "verne", "frame": "part", "pose": {"x": 100, "y": 50, "z": 150, "axis": [0, -0.5, 0.8]},
            "tool_length": 50, "solutions": "feasible", "near": {"x": 1, "y": 2, "z": 1000, "alpha": 3}}),
        ),
        (
            "/fk/batch",
            json!({"joints": [[674, 685, 250], [400, 400, 400, 10, 90], null, [0, 0, 5000]], "tool_length": 50,
            "orientation": "vector"}),
        ),
        (
            "/ik/batch",
            json!({"frame": "part", "tool_length": 50, "continuous": true,
            "start": {"rho": [400, 500, 500], "theta1": 10, "theta2": -350},
            "poses": [[100, 50, 150, 0, 0], [1, 2], [100, 50, 150, 0.1, -0.3, 1], [5000, 0, 0, 0, 0]]}),
        ),
        (
            "/workspace/contains",
            json!({"kind": "part", "tool_length": 50, "phi1": 10, "phi2": 20,
            "points": [[100, 50, 150], [0, 0, 900], null, [5000, 0, 0]]}),
        ),
        (
            "/workspace",
            json!({"machine": "verne", "kind": "part", "tool_length": [50, 60], "phi1":
            {"from": 0, "to": 20, "step": 10}, "phi2": 5, "tolerance": 50}),
        ),
        (
            "/workspace/dexterity",
            json!({"machine": "verne", "tool_length": 50, "phi1": {"from": -20, "to": 20}, "phi2": 0,
            "cell": 400}),
        ),
        (
            "/machines/calibration",
            json!({"machine": "verne", "kind": "part", "tool_length": 100, "sigma": 0.01, "loss": "huber", "next": 2,
            "rho": [[500, 500, 500], [450, 480, 520], [560, 400, 470], [380, 500, 420]],
            "table": [[10, 20], [-20, 90], [5, -60], [0, 180]],
            "points": [[90, 30, 320], [10, -200, 260], [-30, 80, 350], [60, 40, 400]], "fixed": ["R2", "da"],
            "priors": {"L1": {"value": 1050.1, "sigma": 0.02}}, "bounds": {"R1": [270, 280]}}),
        ),
        (
            "/machines/calibration",
            json!({"kind": "distances", "rho": [[500, 500, 500], [450, 480, 520], [560, 400, 470]],
            "pairs": [[0, 1, 120.5], [1, 2, 80], [2, 0, 95.25]]}),
        ),
    ]
});

/// An arbitrary query string to an operation.
pub(crate) fn query(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let (path, parameters) = draw.pick(&QUERIES);
    with_client(|client| {
        let path = path.replace("{}", &id(&mut draw, client));
        let query = if draw.one_in(4) { raw(draw) } else { pairs(&mut draw, parameters) };
        // An invalid URI cannot be sent.
        if let Ok(uri) = format!("{path}?{query}").parse::<Uri>() {
            client.ask(Request::get(uri).body(Body::empty()).unwrap());
        }
    });
}

fn id(draw: &mut Draw<'_>, client: &Client) -> String {
    match draw.below(4) {
        0 | 1 => client.kept.clone(),
        2 => "0123456789abcdef".repeat(4),
        _ => encoded(&draw.text()),
    }
}

/// The remaining bytes, percent-encoded where a URI needs it.
fn raw(draw: Draw<'_>) -> String {
    let visible = |byte: &u8| {
        if (0x21..0x7f).contains(byte) { char::from(*byte).to_string() } else { format!("%{byte:02X}") }
    };
    draw.rest().iter().map(visible).collect()
}

fn encoded(text: &str) -> String {
    form_urlencoded::byte_serialize(text.as_bytes()).collect()
}

/// Parameters, usually each once, with arbitrary values.
fn pairs(draw: &mut Draw<'_>, parameters: &[&str]) -> String {
    let mut query = form_urlencoded::Serializer::new(String::new());
    for name in parameters {
        for _ in 0..draw.pick(&[1, 1, 1, 1, 1, 0, 0, 2]) {
            let value = match draw.below(8) {
                0 => draw.text(),
                1 | 2 => (0..draw.below(7)).map(|_| draw.numeral(500.0)).collect::<Vec<_>>().join(","),
                3 => draw.numeral(500.0),
                4 => format!("{}", draw.between(-1000.0, 1000.0)),
                5 => draw.pick(&["674,685,250", "0,0,1", "0,0,900,5"]).to_owned(),
                6 => draw
                    .pick(&["verne", "part", "platform", "tool", "all", "working", "feasible", "true"])
                    .to_owned(),
                _ => draw
                    .pick(&["glb", "stl", "ply", "json", "svg", "dxf", "running", "10", "reachable"])
                    .to_owned(),
            };
            query.append_pair(name, &value);
        }
    }
    query.finish()
}

/// An arbitrary body to an operation that reads one.
pub(crate) fn body(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let (path, good) = &BODIES[draw.below(BODIES.len())];
    let body = match draw.below(4) {
        0 => draw.rest().to_vec(),
        1 => text(&mut draw).into_bytes(),
        _ => spoilt(&mut draw, good).into_bytes(),
    };
    with_client(|client| client.ask(post(path, body)));
}

/// The built-in machine as JSON.
static MACHINE: LazyLock<Value> = LazyLock::new(|| {
    let request = Request::get("/machines/verne").body(Body::empty()).unwrap();
    let shown: Value = with_client(|client| serde_json::from_slice(&client.ask(request).bytes).unwrap());
    let mut machine = shown["definition"].clone();
    let axes = json!([[0, 0.1, 1], [0, -0.1, 1], [0.1, 0, 1], [0, 0, 1]]);
    machine["limits"]["slider_axes"] = axes.clone();
    machine["limits"]["platform_axes"] = axes;
    machine
});

/// Arbitrary text in the place of a machine.
pub(crate) fn machine(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let good = &*MACHINE;
    let questions = [
        ("/fk", "\"joints\":{\"rho\":[674,685,250]},\"solutions\":\"all\""),
        ("/ik", "\"frame\":\"platform\",\"pose\":{\"x\":0,\"y\":0,\"z\":1000},\"solutions\":\"all\""),
        ("/ik", "\"pose\":{\"x\":100,\"y\":50,\"z\":150,\"phi1\":10,\"phi2\":20},\"tool_length\":50"),
        ("/workspace/contains", "\"kind\":\"part\",\"points\":[[100,50,150],[0,0,400]]"),
    ];
    let (path, question) = draw.pick(&questions);
    let machine = match draw.below(4) {
        0 => String::from_utf8_lossy(draw.rest()).into_owned(),
        1 => text(&mut draw),
        _ => spoilt(&mut draw, good),
    };
    with_client(|client| client.ask(post(path, format!("{{\"machine\":{machine},{question}}}"))));
}

/// Headers that the service reads.
const HEADERS: [&str; 12] = [
    "range",
    "if-range",
    "if-none-match",
    "if-match",
    "accept",
    "prefer",
    "accept-encoding",
    "if-modified-since",
    "content-type",
    "authorization",
    "origin",
    "x-request-id",
];

/// Values that are almost valid.
const VALUES: [&str; 32] = [
    "bytes=0-99",
    "bytes=5-",
    "bytes=-7",
    "bytes=-0",
    "bytes=9-2",
    "bytes=0-18446744073709551615",
    "bytes=0-1,4-5",
    "bytes=18446744073709551616-",
    "bytes=0-0,-1",
    "items=0-5",
    "*",
    "\"\"",
    "W/\"x\"",
    "\"a\", \"b\"",
    "\"unclosed",
    "*/*",
    "model/*;q=0.5",
    "model/stl;q=nan",
    "application/json;q=1e9",
    "model/gltf-binary;q=-1",
    "image/png",
    "/",
    "wait=0",
    "wait=99999999999999999999",
    "respond-async, wait=\"1\"",
    "wait=-1;x=\"",
    "gzip, br;q=0",
    "identity;q=0, *;q=0",
    "Sun, 06 Nov 1994 08:49:37 GMT",
    "Bearer \u{7f}",
    "null",
    ",,;;==",
];

/// Arbitrary headers in requests for stored results.
pub(crate) fn headers(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    with_client(|client| {
        let path = draw.pick(&["mesh", "mesh", "mesh?format=stl", "mesh?format=json", "", "slice?z=300"]);
        let mut request = Request::new(Body::empty());
        *request.method_mut() =
            [Method::GET, Method::HEAD, Method::OPTIONS, Method::GET][draw.below(4)].clone();
        *request.uri_mut() =
            format!("/workspace/{}/{path}", client.kept).trim_end_matches('/').parse().unwrap();
        for _ in 0..=draw.below(4) {
            let name = HeaderName::from_static(draw.pick(&HEADERS));
            let mut value = match draw.below(4) {
                0 => draw.some_bytes().to_vec(),
                _ => draw.pick(&VALUES).as_bytes().to_vec(),
            };
            if draw.one_in(4) {
                value.extend([b", "[draw.below(2)]]);
                value.extend(draw.some_bytes());
            }
            // An invalid header cannot be sent.
            if let Ok(value) = HeaderValue::from_bytes(&value) {
                request.headers_mut().append(name, value);
            }
        }
        client.ask(request);
    });
}
