//! `/workspace/{id}/slice`.

use axum::http::header::{ACCEPT, CONTENT_TYPE, ETAG, IF_NONE_MATCH};
use serde_json::{Value, json};

use super::workspace::ask;
use super::{Reply, get, get_from, service};

async fn cut(kind: &str, query: &str) -> Reply {
    let service = service().await;
    let summary = ask(&service, json!({"kind": kind, "tolerance": 0.1})).await.json;
    let uri = format!("{}/slice?{query}", summary["links"]["self"].as_str().unwrap());
    get_from(&service, &uri, &[]).await
}

fn points(ring: &Value) -> Vec<[f64; 2]> {
    let number = |point: &Value, axis: usize| point[axis].as_f64().unwrap();
    ring.as_array().unwrap().iter().map(|point| [number(point, 0), number(point, 1)]).collect()
}

#[tokio::test]
async fn the_areas_of_slices_sum_to_the_volume() {
    let service = service().await;
    let summary = ask(&service, json!({"tolerance": 0.1})).await.json;
    let bound = |end: &str| summary["bounds"][end][2].as_f64().unwrap();
    let (low, high) = (bound("min"), bound("max"));
    let count = 200;
    let step = (high - low) / f64::from(count);
    let mut volume = 0.0;
    for i in 0..count {
        let z = low + (f64::from(i) + 0.5) * step;
        let uri = format!("{}/slice?z={z}", summary["links"]["self"].as_str().unwrap());
        volume += step * get_from(&service, &uri, &[]).await.json["area"].as_f64().unwrap();
    }
    let wanted = summary["volume"].as_f64().unwrap();
    assert!((volume / wanted - 1.0).abs() < 1e-3, "{volume} is not {wanted}");
}

#[tokio::test]
async fn polygons_are_closed_and_counter_clockwise() {
    let reply = cut("platform", "z=1200").await;
    let polygons = reply.json["polygons"].as_array().unwrap();
    let mut areas = 0.0;
    for polygon in polygons {
        let ring = points(&polygon["outer"]);
        let next = ring.iter().cycle().skip(1);
        let area: f64 = ring.iter().zip(next).map(|(a, b)| (a[0] * b[1] - b[0] * a[1]) / 2.0).sum();
        let holes = polygon["holes"].as_array().unwrap();
        assert!(area > 0.0 && holes.is_empty());
        assert!((area - polygon["area"].as_f64().unwrap()).abs() < 1e-6 * area);
        areas += area;
    }
    assert!((areas - reply.json["area"].as_f64().unwrap()).abs() < 1e-6 * areas);
    assert_eq!((&reply.json["z"], &reply.json["frame"]), (&json!(1200.0), &json!("base")));
    assert!(reply.json.get("contours").is_none());
}

#[tokio::test]
async fn alpha_is_constant_on_its_contour_lines() {
    for query in ["z=1200&alpha=true", "z=1200&alpha=-10,0,10"] {
        let slice = cut("platform", query).await.json;
        let lines = slice["contours"].as_array().unwrap();
        assert!(lines.len() >= 3, "{query}");
        for line in lines {
            let points = points(&line["points"]);
            for [x, y] in [points[0], points[points.len() / 2]] {
                let found = get(&format!("/ik?frame=platform&x={x}&y={y}&z=1200")).await;
                let alpha = found.solutions()[0]["platform"]["alpha"].as_f64().unwrap();
                assert!((alpha - line["alpha"].as_f64().unwrap()).abs() < 1e-6, "{alpha} {line}");
            }
        }
    }
}

#[tokio::test]
async fn drawings_are_svg_and_dxf() {
    let svg = cut("part", "z=300&alpha=true&format=svg").await;
    assert_eq!(svg.headers[CONTENT_TYPE], "image/svg+xml");
    let text = String::from_utf8(svg.bytes).unwrap();
    assert!(
        text.starts_with("<svg")
            && text.contains("viewBox")
            && text.contains("x, mm")
            && text.contains("y up")
    );
    let attribute =
        |name: &str| text.split_once(&format!(" {name}=\"")).unwrap().1.split_once('"').unwrap().0;
    let view: Vec<&str> = attribute("viewBox").split(' ').collect();
    assert_eq!([attribute("width"), attribute("height")], [view[2], view[3]].map(|side| format!("{side}mm")));
}

#[tokio::test]
async fn control_characters_in_a_name_do_not_break_drawings() {
    let service = service().await;
    let mut machine = get("/machines/verne").await.json["definition"].clone();
    machine["name"] = json!("a\u{1}\u{1b}[31m\r\n<&>");
    let summary = ask(&service, json!({"machine": machine, "tolerance": 20})).await.json;
    let uri =
        |format: &str| format!("{}/slice?z=1200&format={format}", summary["links"]["self"].as_str().unwrap());
    let svg = String::from_utf8(get_from(&service, &uri("svg"), &[]).await.bytes).unwrap();
    assert!(svg.chars().all(|c| c == '\n' || !c.is_control()), "{svg}");
    assert!(svg.contains("<title>a\u{FFFD}\u{FFFD}[31m\u{FFFD}\u{FFFD}&lt;&amp;&gt;: "), "{svg}");
    let dxf = String::from_utf8(get_from(&service, &uri("dxf"), &[]).await.bytes).unwrap();
    let (code, comment) = groups(&dxf)[0];
    assert!(code == 999 && comment.starts_with("a  [31m  <&>: "), "{comment}");
}

/// The groups of a DXF file.
fn groups(dxf: &str) -> Vec<(u16, &str)> {
    let lines: Vec<&str> = dxf.lines().collect();
    lines.chunks(2).map(|pair| (pair[0].parse().unwrap(), pair[1])).collect()
}

#[tokio::test]
async fn dxf_states_units_extents_and_alpha() {
    let query = "z=300&alpha=true";
    let slice = cut("part", query).await.json;
    let dxf = cut("part", &format!("{query}&format=dxf")).await;
    assert_eq!(dxf.headers[CONTENT_TYPE], "image/vnd.dxf");
    let text = String::from_utf8(dxf.bytes).unwrap();
    let groups = groups(&text);
    let variable = |name: &str| {
        let at = groups.iter().position(|group| *group == (9, name)).unwrap();
        groups[at + 1..].iter().take_while(|group| group.0 != 9).map(|group| group.1).collect::<Vec<_>>()
    };
    assert_eq!(
        (variable("$ACADVER"), variable("$INSUNITS"), variable("$MEASUREMENT")),
        (vec!["AC1015"], vec!["4"], vec!["1"])
    );
    let outer: Vec<[f64; 2]> =
        slice["polygons"].as_array().unwrap().iter().flat_map(|polygon| points(&polygon["outer"])).collect();
    for axis in 0..2 {
        let sorted = |pick: fn(f64, f64) -> f64| outer.iter().map(|point| point[axis]).reduce(pick).unwrap();
        assert_eq!(variable("$EXTMIN")[axis], format!("{:.6}", sorted(f64::min)));
        assert_eq!(variable("$EXTMAX")[axis], format!("{:.6}", sorted(f64::max)));
    }
    let contours = slice["contours"].as_array().unwrap();
    let alphas: Vec<&str> = groups.iter().filter_map(|group| group.1.strip_suffix("%%d")).collect();
    assert_eq!(alphas.len(), contours.len());
    for (alpha, contour) in alphas.iter().zip(contours) {
        assert!((alpha.parse::<f64>().unwrap() - contour["alpha"].as_f64().unwrap()).abs() < 1e-6);
    }
    // Every object has a handle of its own, below that of the next object to come.
    let seed = u32::from_str_radix(variable("$HANDSEED")[0], 16).unwrap();
    let from = groups.iter().position(|group| *group == (2, "TABLES")).unwrap();
    let handles = groups[from..].iter().filter(|group| [5, 105].contains(&group.0));
    let mut handles: Vec<u32> = handles.map(|group| u32::from_str_radix(group.1, 16).unwrap()).collect();
    let count = handles.len();
    handles.sort_unstable();
    handles.dedup();
    assert_eq!((handles.len(), handles.last().is_some_and(|last| *last < seed)), (count, true));
}

#[tokio::test]
async fn slices_are_negotiated_and_have_etags() {
    let service = service().await;
    let summary = ask(&service, json!({"tolerance": 20})).await.json;
    let uri = format!("{}/slice?z=1200", summary["links"]["self"].as_str().unwrap());
    for (accept, media) in [
        ("*/*", "application/json"),
        ("image/*", "image/svg+xml"),
        ("image/vnd.dxf", "image/vnd.dxf"),
        ("application/dxf, application/json;q=0.9", "application/dxf"),
    ] {
        let reply = get_from(&service, &uri, &[(ACCEPT, accept)]).await;
        assert_eq!(reply.headers[CONTENT_TYPE], media);
        let tag = reply.headers[ETAG].to_str().unwrap();
        let again = get_from(&service, &uri, &[(ACCEPT, accept), (IF_NONE_MATCH, tag)]).await;
        assert_eq!(again.status, 304);
    }
    get_from(&service, &uri, &[(ACCEPT, "model/stl")]).await.assert_problem(406, "not_acceptable");
    for (query, pointer) in [
        ("", "/query/z"),
        ("z=nan", "/query/z"),
        ("z=1e8", "/query/z"),
        ("z=1200&alpha=maybe", "/query/alpha"),
        ("z=1200&alpha=1,200", "/query/alpha"),
        ("z=1200&format=png", "/query/format"),
    ] {
        let uri = format!("{}/slice?{query}", summary["links"]["self"].as_str().unwrap());
        get_from(&service, &uri, &[]).await.assert_bad_field(pointer);
    }
    assert_eq!(cut("platform", "z=5000").await.json["polygons"], json!([]));
}
