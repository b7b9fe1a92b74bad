//! The bytes of every format, stored in files and read back by independent readers.
//!
//! To change the bytes on purpose, run with `VERNE_BLESS=1`, check the difference, and commit the files.

#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

#[path = "support/golden_file.rs"]
mod golden_file;
#[path = "support/solids.rs"]
mod solids;

use std::io::Cursor;

use serde_json::{Value, json};
use verne_mesh::glb::{Options, Up};
use verne_mesh::{Mesh, glb, ply, stl};

fn solids() -> [(&'static str, Mesh); 3] {
    [("block", solids::block()), ("ball", solids::ball()), ("empty", solids::empty())]
}

fn note() -> Value {
    json!({ "unit": "mm", "note": "golden" })
}

fn glb(mesh: &Mesh) -> Vec<u8> {
    let options = Options { name: "solid".to_owned(), up: Up::NegativeZ, extras: note() };
    let mut bytes = Vec::new();
    glb::write(mesh, 60_f64.to_radians(), &options, &mut bytes).unwrap();
    bytes
}

fn stl(mesh: &Mesh) -> Vec<u8> {
    let mut bytes = Vec::new();
    stl::write(mesh, "golden", &mut bytes).unwrap();
    bytes
}

fn ply(mesh: &Mesh) -> Vec<u8> {
    let mut bytes = Vec::new();
    ply::write(mesh, "golden\nof two lines", &mut bytes).unwrap();
    bytes
}

fn json(mesh: &Mesh) -> Vec<u8> {
    let mut bytes = Vec::new();
    verne_mesh::json::write(mesh, &note(), &mut bytes).unwrap();
    bytes
}

#[test]
fn files_equal_the_golden_files() {
    for (name, mesh) in solids() {
        for (extension, bytes) in
            [("glb", glb(&mesh)), ("stl", stl(&mesh)), ("ply", ply(&mesh)), ("json", json(&mesh))]
        {
            golden_file::assert_equal(name, extension, &bytes);
        }
    }
}

#[test]
fn the_gltf_crate_reads_the_glb() {
    let bytes = glb(&solids::block());
    let gltf = gltf::Gltf::from_slice(&bytes).unwrap();
    let scene = gltf.default_scene().unwrap();
    assert_eq!(serde_json::from_str::<Value>(scene.extras().as_ref().unwrap().get()).unwrap(), note());
    let node = scene.nodes().next().unwrap();
    let ([dx, dy, dz], ..) = node.transform().decomposed();
    let place = |[x, y, z]: [f32; 3]| {
        [f64::from(x) + f64::from(dx), f64::from(y) + f64::from(dy), f64::from(z) + f64::from(dz)]
    };
    let mut sixfold = 0.0;
    // Four walls and two ends with four corners of their own each: every edge of a box is a crease.
    let wanted =
        [("wall", [0.061_246, 0.223_228, 0.456_411], 16), ("end", [0.715_694, 0.102_242, 0.021_219], 8)];
    for (primitive, (name, colour, corners)) in node.mesh().unwrap().primitives().zip(wanted) {
        let material = primitive.material();
        assert_eq!(material.name(), Some(name));
        let found = material.pbr_metallic_roughness().base_color_factor();
        assert!(found.iter().zip(colour).all(|(found, wanted)| (found - wanted).abs() < 1e-6), "{found:?}");
        let reader = primitive.reader(|_| gltf.blob.as_deref());
        let positions: Vec<[f64; 3]> = reader.read_positions().unwrap().map(place).collect();
        assert_eq!(positions.len(), corners);
        for (position, normal) in positions.iter().zip(reader.read_normals().unwrap()) {
            // The machine's z points down: what was least in z is on top.
            let up = if position[1] > -0.905 { 1.0 } else { -1.0 };
            assert_eq!(normal[1], if name == "end" { up } else { 0.0 });
        }
        let indices: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
        let corner = |index: &u32| positions[*index as usize];
        sixfold +=
            indices.chunks(3).map(|t| triple(corner(&t[0]), corner(&t[1]), corner(&t[2]))).sum::<f64>();
    }
    assert!((sixfold / 6.0 - 6000e-9).abs() < 1e-11, "{sixfold}");
}

fn triple(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

#[test]
fn the_gltf_crate_reads_an_empty_scene() {
    // Only the chunks: the reader wants a list of nodes, which glTF lets a scene leave out but not leave
    // empty.
    let bytes = glb(&solids::empty());
    let chunks = gltf::Glb::from_slice(&bytes).unwrap();
    assert!(chunks.bin.is_none());
    let read: Value = serde_json::from_slice(&chunks.json).unwrap();
    assert_eq!(read["scenes"], json!([{ "extras": note() }]));
    assert_eq!((read["scene"].as_u64(), read.get("meshes"), read.get("buffers")), (Some(0), None, None));
}

#[test]
fn a_ball_of_two_tags_is_smooth_except_at_its_equator() {
    let gltf = gltf::Gltf::from_slice(&glb(&solids::ball())).unwrap();
    let primitives = gltf.meshes().next().unwrap().primitives();
    let normals: Vec<usize> =
        primitives.map(|primitive| primitive.get(&gltf::Semantic::Normals).unwrap().count()).collect();
    // Eighteen vertices, and the eight on the equator twice, where the tag changes.
    assert_eq!(normals, [13, 13]);
}

#[test]
fn the_stl_io_crate_reads_the_stl() {
    let mesh = solids::ball();
    let read = stl_io::read_stl(&mut Cursor::new(stl(&mesh))).unwrap();
    assert_eq!((read.vertices.len(), read.faces.len()), (18, 32));
    read.validate().unwrap();
    assert_eq!(stl_io::read_stl(&mut Cursor::new(stl(&solids::empty()))).unwrap().faces.len(), 0);
}

#[test]
fn the_ply_rs_crate_reads_the_ply() {
    use ply_rs_bw::ply::{DefaultElement, Property};
    for (_, mesh) in solids() {
        let parser = ply_rs_bw::parser::Parser::<DefaultElement>::new();
        let read = parser.read_ply(&mut Cursor::new(ply(&mesh))).unwrap();
        assert_eq!(read.header.comments[..3], ["unit mm", "golden", "of two lines"]);
        let (vertices, faces) = (&read.payload["vertex"], &read.payload["face"]);
        assert_eq!((vertices.len(), faces.len()), (mesh.positions().len(), mesh.triangles().len()));
        for ((vertex, position), tag) in vertices.iter().zip(mesh.positions()).zip(mesh.vertex_tags()) {
            let found = ["x", "y", "z"].map(|axis| vertex[axis].clone());
            assert_eq!(found, position.map(Property::Double));
            assert_eq!(vertex["tag"], Property::UChar(tag));
        }
        // Several readers take nothing at a face but the list.
        assert!(faces.iter().all(|face| face.keys().eq(["vertex_indices"])));
        let mut lists = faces.iter().map(|face| face["vertex_indices"].clone());
        let mut found = Vec::new();
        for [first, count, tag] in read.header.comments.iter().filter_map(|comment| faces_of(comment)) {
            assert_eq!(first, found.len());
            found.extend(lists.by_ref().take(count).map(|list| (list, tag)));
        }
        let mut wanted: Vec<_> = mesh.triangles().iter().zip(mesh.tags()).collect();
        wanted.sort_by_key(|(_, tag)| **tag);
        let wanted = wanted
            .into_iter()
            .map(|(triangle, &tag)| (Property::ListUInt(triangle.to_vec()), usize::from(tag)));
        assert!(found.into_iter().eq(wanted));
    }
}

/// First face, count and tag, if the comment gives them.
fn faces_of(comment: &str) -> Option<[usize; 3]> {
    let (faces, tag) = comment.strip_prefix("faces ")?.split_once(" tag ")?;
    let (first, count) = faces.split_once(' ')?;
    Some([first, count, tag].map(|number| number.parse().unwrap()))
}

/// MeshLab, VTK and Open3D allow 512, 4,096 and 1,024 bytes for a line.
#[test]
fn a_long_ply_comment_continues_in_the_next_one() {
    let text = "0123456789 ".repeat(500);
    let mut bytes = Vec::new();
    ply::write(&solids::block(), &text, &mut bytes).unwrap();
    let end = bytes.windows(11).position(|window| window == b"end_header\n").unwrap();
    let header = std::str::from_utf8(&bytes[..end]).unwrap();
    assert!(header.lines().all(|line| line.len() < 500));
    assert!(header.replace("\ncomment +", "").contains(&text));
}

#[test]
fn json_reads_back_exactly() {
    let mesh = solids::block();
    let read: Value = serde_json::from_slice(&json(&mesh)).unwrap();
    assert_eq!(read["positions"], json!(mesh.positions().as_flattened()));
    assert_eq!(read["indices"], json!(mesh.triangles().as_flattened()));
    assert_eq!(read["tags"], json!(mesh.vertex_tags()));
    assert_eq!(read["triangle_tags"], json!(mesh.tags()));
    assert_eq!(read["palette"][1], json!({ "name": "end", "rgb": [220, 90, 40] }));
    assert_eq!(read["extras"], note());
    let empty: Value = serde_json::from_slice(&json(&solids::empty())).unwrap();
    assert_eq!((&empty["positions"], &empty["indices"]), (&json!([]), &json!([])));
}
