//! Arbitrary bytes as a packed mesh, and arbitrary meshes through every measure and encoder.

use serde_json::json;
use verne_mesh::glb::{Options, Up};
use verne_mesh::{Mesh, Swatch, glb, json, packed, ply, stl};

use crate::draw::Draw;

/// Arbitrary bytes, a packed mesh with some bytes changed, or a mesh of arbitrary numbers.
pub(crate) fn mesh(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    match draw.below(4) {
        0 => look_at(packed::unpack(draw.rest()).ok()),
        1 => {
            let Some(mesh) = drawn(&mut draw) else { return };
            let mut bytes = packed::pack(&mesh).unwrap();
            for _ in 0..=draw.below(4) {
                let at = (draw.below(256) * 256 + draw.below(256)) % bytes.len();
                bytes[at] ^= draw.byte();
            }
            look_at(packed::unpack(&bytes).ok());
        }
        _ => look_at(drawn(&mut draw)),
    }
}

/// A mesh, if the numbers are valid.
fn drawn(draw: &mut Draw<'_>) -> Option<Mesh> {
    let vertices = draw.below(12);
    let unit = draw.pick(&[1.0, 1000.0, 1e7, 1e-30, 1e300]);
    let positions: Vec<_> = (0..vertices).map(|_| [0; 3].map(|_| draw.number(unit))).collect();
    let (most, colours) = (vertices + usize::from(draw.one_in(16)), draw.below(4));
    let index = |draw: &mut Draw<'_>| u32::try_from(draw.below(most.max(1))).unwrap();
    let triangles: Vec<_> = (0..draw.below(24)).map(|_| [0; 3].map(|_| index(draw))).collect();
    let count = triangles.len() + usize::from(draw.one_in(16));
    let tags = (0..count).map(|_| u8::try_from(draw.below(colours.max(1))).unwrap()).collect();
    let palette =
        (0..colours).map(|_| Swatch { name: draw.text(), rgb: [0; 3].map(|_| draw.byte()) }).collect();
    // Removes unused vertices: two meshes in three would be refused because of them.
    let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    if used.last().is_some_and(|last| *last as usize >= vertices) {
        return Mesh::new(positions, triangles, tags, palette).ok();
    }
    let place = |old: &u32| u32::try_from(used.binary_search(old).unwrap()).unwrap();
    let triangles = triangles.iter().map(|corners| corners.map(|old| place(&old))).collect();
    let positions = used.iter().map(|&old| positions[old as usize]).collect();
    Mesh::new(positions, triangles, tags, palette).ok()
}

fn look_at(mesh: Option<Mesh>) {
    let Some(mesh) = mesh else { return };
    assert_eq!(packed::unpack(&packed::pack(&mesh).unwrap()).unwrap(), mesh);
    let audit = mesh.audit();
    let bounds = mesh.bounds();
    assert_eq!(bounds.is_none(), mesh.positions().is_empty());
    let (volume, area) = (mesh.volume(), mesh.area());
    let height = bounds.map_or(0.0, |bounds| bounds.centre()[2]);
    let contours = mesh.section(height);
    let moderate = mesh.positions().as_flattened().iter().all(|n| n.abs() <= 1e8);
    if moderate {
        assert!(volume.is_finite() && area.is_finite() && area >= 0.0, "{volume} {area}");
        assert!(contours.iter().all(|contour| contour.area().is_finite()), "{contours:?}");
    }
    assert_eq!(mesh.vertex_tags().len(), mesh.positions().len());
    assert!(!audit.is_watertight() || contours.iter().all(|contour| contour.points.len() > 2));
    for up in [Up::PositiveZ, Up::NegativeZ] {
        let options = Options { name: "any".to_owned(), up, extras: json!({"any": height}) };
        glb::write(&mesh, 0.5, &options, std::io::sink()).unwrap();
    }
    stl::write(&mesh, "any ü", std::io::sink()).unwrap();
    ply::write(&mesh, "any\nlines", std::io::sink()).unwrap();
    let mut text = Vec::new();
    json::write(&mesh, &json!({"any": 1}), &mut text).unwrap();
    let read: serde_json::Value = serde_json::from_slice(&text).unwrap();
    assert_eq!(read["positions"].as_array().unwrap().len(), 3 * mesh.positions().len());
}
