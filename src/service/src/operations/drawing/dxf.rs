//! DXF of AutoCAD 2000 (AC1015), which every CAD program reads: closed polylines on three layers at the height of
//! the cut, and the values of alpha as text. Units are mm.

pub(crate) mod frame;
pub(crate) mod tags;

use crate::operations::drawing::dxf::frame::Spaces;
use crate::operations::drawing::dxf::tags::{Body, Tags};
use crate::operations::drawing::extent::{Extent, NOTHING, shown};
use crate::wire::fixed_array::Pair;
use crate::wire::slice::SliceObject;

/// Layers with their colours (AutoCAD's numbers). Layer 0 is in every drawing.
const LAYERS: [(&str, u8); 4] = [("0", 7), ("OUTER", 5), ("HOLES", 1), ("ALPHA", 8)];

/// Writes a slice.
pub(crate) fn write(slice: &SliceObject, title: &str) -> String {
    let extent = Extent::of(slice);
    let mut body = Body::default();
    let spaces =
        crate::operations::drawing::dxf::frame::tables(&mut body, &LAYERS, extent.unwrap_or(NOTHING));
    crate::operations::drawing::dxf::frame::blocks(&mut body, spaces);
    body.section("ENTITIES");
    entities(&mut body, slice, spaces, extent.unwrap_or(NOTHING).letters());
    body.put(0, "ENDSEC");
    crate::operations::drawing::dxf::frame::objects(&mut body);

    let mut file = Tags::default();
    let ascii: String = title.chars().map(|c| if c.is_ascii_graphic() { c } else { ' ' }).collect();
    file.put(999, format_args!("{ascii}; unit mm; {}", slice.id));
    header(&mut file, extent, slice.z, body.next_handle());
    file.append(&body);
    file.put(0, "EOF");
    file.into_text()
}

fn header(file: &mut Tags, extent: Option<Extent>, z: f64, next_handle: u32) {
    // An empty drawing has these in AutoCAD.
    let Extent { min, max } = extent.unwrap_or(Extent { min: [1e20; 2], max: [-1e20; 2] });
    file.section("HEADER");
    for (name, code, value) in [
        ("$ACADVER", 1, "AC1015"),
        ("$DWGCODEPAGE", 3, "ANSI_1252"),
        // Millimetres.
        ("$INSUNITS", 70, "4"),
        // Metric.
        ("$MEASUREMENT", 70, "1"),
    ] {
        file.put(9, name);
        file.put(code, value);
    }
    for (name, [x, y]) in [("$EXTMIN", min), ("$EXTMAX", max), ("$LIMMIN", min), ("$LIMMAX", max)] {
        file.put(9, name);
        file.number(10, x);
        file.number(20, y);
        if name.starts_with("$EXT") {
            file.number(30, z);
        }
    }
    file.put(9, "$HANDSEED");
    file.put(5, format_args!("{next_handle:X}"));
    file.put(0, "ENDSEC");
}

fn entities(body: &mut Body, slice: &SliceObject, spaces: Spaces, letters: f64) {
    for polygon in &slice.polygons {
        polyline(body, spaces, "OUTER", &polygon.outer, slice.z, true);
        for hole in &polygon.holes {
            polyline(body, spaces, "HOLES", hole, slice.z, true);
        }
    }
    for line in &slice.contours {
        polyline(body, spaces, "ALPHA", &line.points, slice.z, false);
        if let Some(start) = line.points.first() {
            alpha(body, spaces, shown(line.alpha), [start.0[0], start.0[1], slice.z], letters);
        }
    }
}

fn polyline(body: &mut Body, spaces: Spaces, layer: &str, points: &[Pair], z: f64, closed: bool) {
    entity(body, spaces, "LWPOLYLINE", layer);
    body.put(100, "AcDbPolyline");
    body.put(90, points.len());
    body.put(70, u8::from(closed));
    body.number(38, z);
    for point in points {
        let [x, y] = point.0;
        body.number(10, x);
        body.number(20, y);
    }
}

/// A value of alpha, degrees, at the start of its line.
fn alpha(body: &mut Body, spaces: Spaces, degrees: f64, [x, y, z]: [f64; 3], height: f64) {
    entity(body, spaces, "TEXT", "ALPHA");
    body.put(100, "AcDbText");
    for (code, number) in [(10, x), (20, y), (30, z), (40, height)] {
        body.number(code, number);
    }
    // %%d is the degree sign.
    body.put(1, format_args!("{degrees}%%d"));
    body.put(100, "AcDbText");
}

fn entity(body: &mut Body, spaces: Spaces, kind: &str, layer: &str) {
    body.object(kind, spaces.model);
    body.put(100, "AcDbEntity");
    body.put(8, layer);
}
