//! `/atlas`: regions that agree with `/fk` and `/ik`, formats, caching, refused requests.

use axum::http::header::{
    ACCEPT, CACHE_CONTROL, CONTENT_DISPOSITION, CONTENT_TYPE, ETAG, IF_NONE_MATCH, VARY,
};
use serde_json::{Value, json};

use super::{Reply, get, get_from, post, service};

fn ring(points: &Value) -> Vec<[f64; 2]> {
    let number = |point: &Value, axis: usize| point[axis].as_f64().unwrap();
    points.as_array().unwrap().iter().map(|point| [number(point, 0), number(point, 1)]).collect()
}

/// The rings of a face, the outer one first.
fn rings(face: &Value) -> Vec<Vec<[f64; 2]>> {
    let holes = face["holes"].as_array().unwrap();
    std::iter::once(&face["outer"]).chain(holes).map(ring).collect()
}

/// Positive if the ring is counter-clockwise.
fn area(ring: &[[f64; 2]]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(a, b)| (a[0] * b[1] - b[0] * a[1]) / 2.0).sum()
}

/// Whether a ray to the right crosses the rings an odd number of times.
fn is_within([u, v]: [f64; 2], rings: &[Vec<[f64; 2]>]) -> bool {
    let sides = rings.iter().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
    let crossed = sides
        .filter(|(a, b)| (a[1] > v) != (b[1] > v) && u < a[0] + (v - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
    crossed.count() % 2 == 1
}

/// The distance of a point from the nearest side.
fn distance([u, v]: [f64; 2], rings: &[Vec<[f64; 2]>]) -> f64 {
    let sides = rings.iter().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
    let distances = sides.map(|(a, b)| {
        let along = [b[0] - a[0], b[1] - a[1]];
        let square = along[0].powi(2) + along[1].powi(2);
        let part = if square == 0.0 {
            0.0
        } else {
            (((u - a[0]) * along[0] + (v - a[1]) * along[1]) / square).clamp(0.0, 1.0)
        };
        (u - a[0] - part * along[0]).hypot(v - a[1] - part * along[1])
    });
    distances.fold(f64::INFINITY, f64::min)
}

/// The question whose solutions an atlas counts at a point of its plane.
fn question(space: &str, [u, v]: [f64; 2]) -> String {
    match space {
        "platform" => format!("/ik?frame=platform&x={u}&y={v}&z=1200&solutions=all"),
        _ => format!("/fk?rho=400,{},{}&solutions=all", 400.0 + u, 400.0 + v),
    }
}

#[tokio::test]
async fn regions_have_the_numbers_of_solutions_of_fk_and_ik() {
    let service = service().await;
    for (machine, space) in
        [("verne", "platform"), ("verne", "joints"), ("linear-delta", "platform"), ("linear-delta", "joints")]
    {
        let answer = get_from(&service, &format!("/atlas?machine={machine}&space={space}"), &[]).await.json;
        let regions: Vec<_> = answer["regions"].as_array().unwrap().iter().collect();
        let outlines: Vec<_> = regions.iter().map(|region| rings(region)).collect();
        let tolerance = answer["tolerance"].as_f64().unwrap();
        let (u, v) = (&answer["window"]["u"], &answer["window"]["v"]);
        let [u, v] = [u, v].map(|side| [side[0].as_f64().unwrap(), side[1].as_f64().unwrap()]);
        let mut compared = 0;
        // Points of a sequence that fills the window evenly.
        for i in 1..300_u32 {
            let part = |step: f64| (f64::from(i) * step).fract();
            let point =
                [u[0] + part(0.754_877_666) * (u[1] - u[0]), v[0] + part(0.569_840_291) * (v[1] - v[0])];
            let Some(inside) = outlines.iter().position(|rings| is_within(point, rings)) else {
                panic!("{machine}, {space}: {point:?} is in no region");
            };
            if distance(point, &outlines[inside]) < 2.0 * tolerance {
                continue;
            }
            let question = format!("{}&machine={machine}", question(space, point));
            let found = get_from(&service, &question, &[]).await.solutions().len();
            assert_eq!(regions[inside]["solutions"], found, "{machine}, {space}: {point:?}");
            compared += 1;
        }
        assert!(compared > 200, "{compared}");
    }
}

#[tokio::test]
async fn regions_tile_the_window_and_have_the_areas_of_their_rings() {
    for space in ["platform", "joints"] {
        let answer = get(&format!("/atlas?space={space}&u_min=-300&v_max=250")).await.json;
        assert_eq!((&answer["space"], &answer["machine"]["name"]), (&json!(space), &json!("verne")));
        let (u, v) = (&answer["window"]["u"], &answer["window"]["v"]);
        assert_eq!((&u[0], &v[1]), (&json!(-300.0), &json!(250.0)));
        let side = |side: &Value| side[1].as_f64().unwrap() - side[0].as_f64().unwrap();
        let (mut whole, mut error) = (0.0, 0.0);
        for region in answer["regions"].as_array().unwrap() {
            let rings = rings(region);
            assert!(area(&rings[0]) > 0.0 && rings[1..].iter().all(|hole| area(hole) < 0.0));
            assert!(is_within(ring(&json!([region["label"]]))[0], &rings));
            // The area is that within the curves, the rings are within the tolerance of them.
            let polygon: f64 = rings.iter().map(|ring| area(ring)).sum();
            let perimeter: f64 = rings
                .iter()
                .flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)))
                .map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]))
                .sum();
            let stated = region["area"].as_f64().unwrap();
            assert!((stated - polygon).abs() <= answer["tolerance"].as_f64().unwrap() * perimeter);
            whole += stated;
            error += region["area_error"].as_f64().unwrap();
        }
        let window = side(u) * side(v);
        assert!((whole - window).abs() <= error + 1e-9 * window, "{whole} {window} {error}");
    }
}

#[tokio::test]
async fn formats_are_negotiated_and_have_etags() {
    let service = service().await;
    let uri = "/atlas?tolerance=20";
    for (accept, media, path) in [
        ("*/*", "application/json", "/atlas?tolerance=20&format=json"),
        ("image/*", "image/svg+xml", "/atlas.svg?tolerance=20"),
        ("image/vnd.dxf", "image/vnd.dxf", "/atlas.dxf?tolerance=20"),
    ] {
        let reply = get_from(&service, uri, &[(ACCEPT, accept)]).await;
        assert_eq!(reply.headers[CONTENT_TYPE], media);
        assert_eq!(reply.headers[CACHE_CONTROL], "public, max-age=300");
        assert!(reply.headers.get_all(VARY).iter().any(|vary| vary == "accept"));
        assert!(reply.headers[CONTENT_DISPOSITION].to_str().unwrap().contains("\"atlas-platform."));
        let tag = reply.headers[ETAG].to_str().unwrap();
        let again = get_from(&service, uri, &[(ACCEPT, accept), (IF_NONE_MATCH, tag)]).await;
        assert_eq!((again.status.as_u16(), again.bytes.len()), (304, 0));
        let of_path = get_from(&service, path, &[]).await;
        assert!(of_path.bytes == reply.bytes && of_path.headers[CONTENT_TYPE] == media, "{path}");
    }
    get_from(&service, uri, &[(ACCEPT, "model/stl")]).await.assert_problem(406, "not_acceptable");
}

#[tokio::test]
async fn a_posted_machine_has_the_atlas_of_its_name() {
    let definition = get("/machines/linear-delta").await.json["definition"].clone();
    let body = |machine: Value| json!({"machine": machine, "space": "joints", "tolerance": 10});
    let [posted, named] =
        [post("/atlas", body(definition)).await, post("/atlas", body(json!("linear-delta"))).await];
    assert_eq!(posted.status, 200, "{}", posted.json);
    assert_eq!(posted.json, named.json);
    let asked = get("/atlas?machine=linear-delta&space=joints&tolerance=10").await;
    assert_eq!(asked.bytes, posted.bytes);
    assert!(posted.headers.contains_key(ETAG) && !posted.headers.contains_key(CACHE_CONTROL));
    for (path, media) in [("/atlas.svg", "image/svg+xml"), ("/atlas?format=dxf", "image/vnd.dxf")] {
        let drawing = post(path, body(json!("verne"))).await;
        assert_eq!((drawing.status.as_u16(), &drawing.headers[CONTENT_TYPE]), (200, &media.parse().unwrap()));
    }
}

async fn drawing(format: &str) -> (String, Value) {
    let Reply { bytes, .. } = get(&format!("/atlas.{format}?space=joints&tolerance=5")).await;
    (String::from_utf8(bytes).unwrap(), get("/atlas?space=joints&tolerance=5").await.json)
}

fn count(list: &Value) -> usize {
    list.as_array().unwrap().len()
}

#[tokio::test]
async fn svg_shows_each_region_and_each_special_point() {
    let (svg, atlas) = drawing("svg").await;
    assert!(svg.starts_with("<svg") && svg.contains("rho2 - rho1, mm") && svg.contains("det_P = 0"));
    let regions = svg.matches(" solutions, ").count();
    assert_eq!(regions, count(&atlas["regions"]));
    assert_eq!(svg.matches("<circle").count(), count(&atlas["points"]));
    assert_eq!(svg.matches("url(#working)").count(), count(&atlas["working"]["regions"]));
}

#[tokio::test]
async fn dxf_has_a_layer_for_each_number_of_solutions() {
    let (dxf, atlas) = drawing("dxf").await;
    let lines: Vec<&str> = dxf.lines().collect();
    let groups: Vec<(u16, &str)> =
        lines.chunks(2).map(|pair| (pair[0].trim().parse().unwrap(), pair[1])).collect();
    let kinds = |kind: &str, layer: &str| {
        let entities = groups.split(|group| group.0 == 0 && group.1 != kind);
        let entities = entities.flat_map(|part| part.split(|group| *group == (0, kind)).skip(1));
        entities.filter(|entity| entity.contains(&(8, layer))).count()
    };
    for solutions in [4, 6] {
        let of_number = |region: &&Value| region["solutions"] == solutions;
        let regions: Vec<_> = atlas["regions"].as_array().unwrap().iter().filter(of_number).collect();
        let layer = format!("SOLUTIONS_{solutions}");
        let outlines: usize = regions.iter().map(|region| 1 + count(&region["holes"])).sum();
        assert_eq!(
            (kinds("LWPOLYLINE", &layer), kinds("TEXT", &layer)),
            (outlines, regions.len()),
            "{layer}"
        );
    }
    assert_eq!(kinds("LWPOLYLINE", "PARALLEL"), count(&atlas["curves"]));
    assert_eq!(kinds("POINT", "POINTS"), count(&atlas["points"]));
    let named = |name: &str| groups.windows(2).any(|pair| pair[0] == (2, name) && pair[1] == (70, "0"));
    assert!(["SOLUTIONS_4", "SOLUTIONS_6", "PARALLEL", "POINTS", "WORKING"].into_iter().all(named));
}

#[tokio::test]
async fn bad_windows_and_tolerances_are_refused() {
    for (query, pointer) in [
        ("space=moon", "/query/space"),
        ("u_min=nan", "/query/u_min"),
        ("u_max=-2000", "/query/u_max"),
        ("u_min=2000", "/query/u_min"),
        ("v_min=10&v_max=10", "/query/v_max"),
        ("v_min=-1e9", "/query/v_min"),
        ("tolerance=0", "/query/tolerance"),
        ("tolerance=500", "/query/tolerance"),
        ("machine=nautilus", "/query/machine"),
        ("format=png", "/query/format"),
        ("z=1", "/query/z"),
    ] {
        get(&format!("/atlas?{query}")).await.assert_bad_field(pointer);
    }
    for (body, pointer) in [
        (json!({"tolerance": 0}), "/tolerance"),
        (json!({"u_min": 2000}), "/u_min"),
        (json!({"machine": "nautilus"}), "/machine"),
        (json!({"window": 1}), "/window"),
    ] {
        post("/atlas", body).await.assert_bad_field(pointer);
    }
    get("/atlas.svg?format=dxf").await.assert_bad_field("/query/format");
    let both = get("/atlas?u_min=1e9&v_min=1e9").await;
    assert_eq!(both.json["errors"].as_array().unwrap().len(), 2, "{}", both.json);
}
