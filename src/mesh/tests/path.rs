//! Paths as GLB, stored in a file and read back by an independent reader.

#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

#[path = "support/golden_file.rs"]
mod golden_file;
#[path = "support/paths.rs"]
mod paths;

use gltf::Semantic;
use gltf::mesh::Mode;
use serde_json::json;
use verne_mesh::glb::{Options, Up, write_path};
use verne_mesh::{ColourScale, MeshError, Path, PathBuilder, Stroke, Swatch};

fn glb(path: &Path) -> Vec<u8> {
    let extras = json!({ "points_per_vertex": path.points_per_vertex() });
    let options = Options { name: "path".to_owned(), up: Up::PositiveZ, extras };
    let mut bytes = Vec::new();
    write_path(path, &options, &mut bytes).unwrap();
    bytes
}

/// A primitive: mode, name, points in mm with z up, and indices.
type Primitive = (Mode, String, Vec<[f64; 3]>, Vec<u32>);

/// The primitives, and the colours of the coloured one.
fn read(bytes: &[u8]) -> (Vec<Primitive>, Vec<[f32; 3]>) {
    let gltf = gltf::Gltf::from_slice(bytes).unwrap();
    let node = gltf.nodes().next().unwrap();
    let (offset, ..) = node.transform().decomposed();
    let millimetres = |axis: usize, metres: f32| 1000.0 * (f64::from(metres) + f64::from(offset[axis]));
    let mut colours = Vec::new();
    let mut primitives = Vec::new();
    for primitive in node.mesh().unwrap().primitives() {
        let reader = primitive.reader(|_| gltf.blob.as_deref());
        let points = reader.read_positions().unwrap();
        let points = points.map(|[x, y, z]| [millimetres(0, x), -millimetres(2, z), millimetres(1, y)]);
        let indices = reader.read_indices().unwrap().into_u32().collect();
        let name = primitive.material().name().unwrap().to_owned();
        colours
            .extend(reader.read_colors(0).into_iter().flat_map(gltf::mesh::util::ReadColors::into_rgb_f32));
        assert_eq!(primitive.get(&Semantic::Colors(0)).is_some(), name == "feed");
        primitives.push((primitive.mode(), name, points.collect(), indices));
    }
    (primitives, colours)
}

#[test]
fn the_file_equals_the_golden_file() {
    golden_file::assert_equal("path", "glb", &glb(&paths::square(100)));
}

#[test]
fn the_gltf_crate_reads_the_lines() {
    let path = paths::square(100);
    let (primitives, colours) = read(&glb(&path));
    let expected = [("feed", vec![1, 2, 2, 3, 3, 4, 4, 5]), ("rapid", vec![0, 1, 6, 7])];
    assert_eq!(primitives.len(), 2);
    for ((mode, name, points, indices), expected) in primitives.into_iter().zip(expected) {
        assert_eq!((mode, name.as_str(), indices), (Mode::Lines, expected.0, expected.1));
        let near = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-4);
        assert!(points.iter().zip(path.points()).all(|(a, b)| near(a, b)), "{points:?}");
    }
    // The least value is yellow, the greatest one dark blue, and both in linear light.
    let [yellow, blue] = [colours[3], colours[0]];
    assert!((yellow[0] - 0.9911).abs() < 1e-3 && (yellow[2] - 0.0395).abs() < 1e-3, "{yellow:?}");
    assert!(blue[0] == 0.0 && (blue[2] - 0.0762).abs() < 1e-3, "{blue:?}");
}

#[test]
fn a_long_path_is_thinned_and_keeps_its_least_value_and_its_coloured_stretch() {
    for most in 1..8 {
        let path = paths::square(most);
        assert!(path.points().len() as u64 <= most + 1 && path.points_per_vertex() > 1);
        assert_eq!(path.values().iter().copied().fold(f64::INFINITY, f64::min), 0.0);
        assert!(path.strokes().contains(&Stroke::Coloured));
        assert_eq!(path.points().last(), Some(&[-50.0, 50.0, 500.0]));
        let (primitives, _) = read(&glb(&path));
        assert_eq!(primitives[0].1, "feed");
    }
}

#[test]
fn a_path_without_segments_is_an_empty_scene() {
    let plain = Swatch { name: "rapid".to_owned(), rgb: [128; 3] };
    let mut builder = PathBuilder::new(0, 0);
    builder.push([1.0; 3], 0.0, Stroke::Coloured).unwrap();
    let path = builder.finish("feed".to_owned(), plain, ColourScale { least: 0.0, greatest: 1.0 });
    let bytes = glb(&path);
    let chunks = gltf::Glb::from_slice(&bytes).unwrap();
    assert!(chunks.bin.is_none());
}

#[test]
fn a_point_that_is_not_finite_is_refused() {
    let mut builder = PathBuilder::new(1, 1);
    let refused = Err(MeshError::NotFinite { vertex: 0 });
    assert_eq!(builder.push([0.0, f64::NAN, 0.0], 0.0, Stroke::Plain), refused);
    assert_eq!(builder.push([0.0; 3], f64::INFINITY, Stroke::Plain), refused);
}
