//! AutoCAD's R12 DXF, the oldest that every CAD program reads: closed polylines on three layers, at the height of
//! the cut. Units are mm; R12 has no room to say so but a comment and `$INSUNITS`, which later programs read.

use std::fmt::{Display, Write};

use crate::wire::numbers::Pair;
use crate::wire::slice::SliceObject;

/// Layers with their colours (AutoCAD's numbers).
const LAYERS: [(&str, u8); 3] = [("OUTER", 5), ("HOLES", 1), ("ALPHA", 8)];

/// Writes a slice.
pub(crate) fn write(slice: &SliceObject, title: &str) -> String {
    let mut file = Tags(String::new());
    let ascii: String = title.chars().map(|c| if c.is_ascii_graphic() { c } else { ' ' }).collect();
    file.put(999, format_args!("{ascii}; unit mm; {}", slice.id));
    header(&mut file);
    layers(&mut file);
    file.open("ENTITIES");
    for polygon in &slice.polygons {
        polyline(&mut file, "OUTER", &polygon.outer, slice.z, true);
        for hole in &polygon.holes {
            polyline(&mut file, "HOLES", hole, slice.z, true);
        }
    }
    for line in &slice.contours {
        polyline(&mut file, "ALPHA", &line.points, slice.z, false);
    }
    file.put(0, "ENDSEC");
    file.put(0, "EOF");
    file.0
}

/// Lines in pairs: a group's code and its value.
struct Tags(String);

impl Tags {
    fn put(&mut self, code: u16, value: impl Display) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.0, "{code}\n{value}");
    }

    fn open(&mut self, section: &str) {
        self.put(0, "SECTION");
        self.put(2, section);
    }

    fn point(&mut self, [x, y, z]: [f64; 3]) {
        for (code, coordinate) in [(10, x), (20, y), (30, z)] {
            self.put(code, format_args!("{coordinate:.6}"));
        }
    }
}

fn header(file: &mut Tags) {
    file.open("HEADER");
    file.put(9, "$ACADVER");
    file.put(1, "AC1009");
    file.put(9, "$INSUNITS");
    file.put(70, 4);
    file.put(0, "ENDSEC");
}

fn layers(file: &mut Tags) {
    file.open("TABLES");
    file.put(0, "TABLE");
    file.put(2, "LAYER");
    file.put(70, LAYERS.len());
    for (name, colour) in LAYERS {
        file.put(0, "LAYER");
        file.put(2, name);
        file.put(70, 0);
        file.put(62, colour);
        file.put(6, "CONTINUOUS");
    }
    file.put(0, "ENDTAB");
    file.put(0, "ENDSEC");
}

fn polyline(file: &mut Tags, layer: &str, points: &[Pair], z: f64, closed: bool) {
    file.put(0, "POLYLINE");
    file.put(8, layer);
    file.put(66, 1);
    file.put(70, u8::from(closed));
    file.point([0.0, 0.0, z]);
    for point in points {
        let [x, y] = point.0;
        file.put(0, "VERTEX");
        file.put(8, layer);
        file.point([x, y, z]);
    }
    file.put(0, "SEQEND");
    file.put(8, layer);
}
