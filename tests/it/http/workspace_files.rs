//! Mesh files, read by independent readers.

use std::collections::HashMap;
use std::io::Cursor;

use serde_json::{Value, json};

use super::workspace::ask;
use super::{Reply, get_from, service};

async fn mesh(question: Value, format: &str) -> (Reply, Value) {
    let service = service().await;
    let summary = ask(&service, question).await.json;
    let uri = format!("{}?format={format}", summary["links"]["mesh"].as_str().unwrap());
    (get_from(&service, &uri, &[]).await, summary)
}

/// Volume of the triangles, about their first corner.
fn volume(positions: &[[f64; 3]], triangles: &[[usize; 3]]) -> f64 {
    let [ox, oy, oz] = positions[0];
    let six = triangles.iter().map(|triangle| {
        let [a, b, c] = triangle.map(|corner| {
            let [x, y, z] = positions[corner];
            [x - ox, y - oy, z - oz]
        });
        a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    });
    six.sum::<f64>() / 6.0
}

fn assert_volume(found: f64, summary: &Value) {
    let wanted = summary["volume"].as_f64().unwrap();
    assert!((found / wanted - 1.0).abs() < 2e-3, "{found} is not about {wanted}");
}

/// Each directed edge once, and once the other way: closed, and oriented.
fn assert_watertight(triangles: &[[usize; 3]]) {
    let mut edges = HashMap::new();
    for [a, b, c] in triangles {
        for edge in [(a, b), (b, c), (c, a)] {
            *edges.entry(edge).or_insert(0) += 1;
        }
    }
    assert!(edges.iter().all(|(&(a, b), &count)| count == 1 && edges.get(&(b, a)) == Some(&1)));
}

fn triples<T: Copy>(flat: &[T]) -> Vec<[T; 3]> {
    flat.chunks_exact(3).map(|three| [three[0], three[1], three[2]]).collect()
}

#[tokio::test]
async fn json_is_flat_and_watertight() {
    let (reply, summary) = mesh(json!({"kind": "part", "tool_length": 50}), "json").await;
    let numbers = |name: &str| reply.json[name].as_array().unwrap().clone();
    let positions: Vec<f64> = numbers("positions").iter().map(|number| number.as_f64().unwrap()).collect();
    let indices: Vec<usize> =
        numbers("indices").iter().map(|index| usize::try_from(index.as_u64().unwrap()).unwrap()).collect();
    let (positions, triangles) = (triples(&positions), triples(&indices));
    assert_eq!(summary["vertices"], positions.len());
    assert_eq!(summary["triangles"], triangles.len());
    assert_watertight(&triangles);
    assert_volume(volume(&positions, &triangles), &summary);
    let about = &reply.json["extras"];
    assert_eq!((&about["unit"], &about["frame"]), (&json!("mm"), &json!("part")));
    assert_eq!((&about["id"], &about["request"]), (&summary["id"], &summary["request"]));
    assert_eq!(about["machine"]["hash"], summary["machine"]["hash"]);
    assert!(about["machine"]["description"].as_str().unwrap().contains("Not Fatronik's"));
    let names: Vec<&str> = about["constraints"]
        .as_array()
        .unwrap()
        .iter()
        .map(|swatch| swatch["name"].as_str().unwrap())
        .collect();
    assert!(names.contains(&"stroke slider1.max") && names.contains(&"slider_joint rod21"), "{names:?}");
}

#[tokio::test]
async fn glb_is_in_metres_with_y_up() {
    for (question, up) in [
        (json!({"kind": "platform"}), [0, 2, 1, -1]),
        (json!({"kind": "part", "tool_length": 50}), [0, 2, 1, 1]),
    ] {
        let (reply, summary) = mesh(question, "glb").await;
        let file = gltf::Gltf::from_slice(&reply.bytes).unwrap();
        let node = file.nodes().next().unwrap();
        let moved = node.transform().decomposed().0;
        let extras = file.default_scene().or_else(|| file.scenes().next()).unwrap().extras().clone().unwrap();
        let extras: Value = serde_json::from_str(extras.get()).unwrap();
        assert_eq!(extras["id"], summary["id"]);
        assert_eq!((&extras["unit"], &extras["machine_unit"]), (&json!("m"), &json!("mm")));
        let (mut least, mut indices, mut names) = (f64::INFINITY, 0, Vec::new());
        for primitive in node.mesh().unwrap().primitives() {
            least = least.min(f64::from(primitive.bounding_box().min[1] + moved[1]) * 1000.0);
            let reader = primitive.reader(|_| file.blob.as_deref());
            indices += reader.read_indices().unwrap().into_u32().count();
            names.push(primitive.material().name().unwrap().to_owned());
        }
        let [_, axis, _, sign] = up;
        // glTF's y is the frame's z, upwards.
        let wanted = if sign > 0 { &summary["bounds"]["min"][2] } else { &summary["bounds"]["max"][2] };
        assert_eq!(axis, 2);
        assert!((least - f64::from(sign) * wanted.as_f64().unwrap()).abs() < 1e-3, "{least} {wanted}");
        assert_eq!(json!(indices / 3), summary["triangles"]);
        // A reader can select the limit of a surface by name.
        let limits = extras["constraints"].as_array().unwrap().iter().map(|limit| &limit["name"]);
        assert!(names.iter().eq(limits), "{names:?}");
    }
}

#[tokio::test]
async fn stl_is_in_millimetres_and_closed() {
    let (reply, summary) = mesh(json!({"kind": "tool", "tool_length": 50}), "stl").await;
    let read = stl_io::read_stl(&mut Cursor::new(&reply.bytes)).unwrap();
    assert_eq!(summary["triangles"], read.faces.len());
    let positions: Vec<[f64; 3]> =
        read.vertices.iter().map(|vertex| std::array::from_fn(|i| f64::from(vertex[i]))).collect();
    let triangles: Vec<[usize; 3]> = read.faces.iter().map(|face| face.vertices).collect();
    assert_volume(volume(&positions, &triangles), &summary);
}

#[tokio::test]
async fn ply_states_its_unit_and_tags() {
    let (reply, summary) = mesh(json!({"kind": "tool", "tool_length": 50}), "ply").await;
    let end = reply.bytes.windows(11).position(|window| window == b"end_header\n").unwrap();
    let header = std::str::from_utf8(&reply.bytes[..end]).unwrap();
    assert!(header.contains(&format!("comment id {}", summary["id"].as_str().unwrap())), "{header}");
    assert!(header.contains("Not Fatronik's"), "{header}");
    assert!(header.contains(&format!("element face {}", summary["triangles"])), "{header}");
    // meshio and PyMesh take nothing at a face but the list of its vertices.
    assert!(header.ends_with("property list uint8 uint32 vertex_indices\n"), "{header}");
}
