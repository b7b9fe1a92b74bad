//! Slices as DXF of AutoCAD 2000 (AC1015), which every CAD program reads: closed polylines on three layers at the
//! height of the slice, and the values of alpha as text. Units are mm.
//!
//! A DXF file is a sequence of pairs of lines: a group code and its value. Objects have handles, hexadecimal numbers.

use std::fmt::{Display, Write};

use crate::operations::drawing::extent::{EMPTY_SLICE, Extent, displayed};
use crate::wire::fixed_array::Pair;
use crate::wire::slice::SliceObject;

/// The sections TABLES and BLOCKS, which a drawing of AC1015 must have. They define the layers OUTER, HOLES and ALPHA.
/// The names in braces stand for the first view.
const TABLES_AND_BLOCKS: &str = include_str!("dxf/tables_and_blocks.dxf");

/// The handle of the model space in [`TABLES_AND_BLOCKS`]: it owns the entities.
const MODEL_SPACE: u32 = 0x15;

/// The first handle that [`TABLES_AND_BLOCKS`] does not use.
const FIRST_HANDLE: u32 = 0x1B;

/// Height of the first view as a multiple of the drawing's.
const VIEW: f64 = 1.2;

/// The text of a file, or of a part of it.
struct Dxf {
    text: String,
    next_handle: u32,
}

impl Dxf {
    fn put(&mut self, code: u16, value: impl Display) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.text, "{code}\n{value}");
    }

    fn numbers(&mut self, numbers: impl IntoIterator<Item = (u16, f64)>) {
        for (code, number) in numbers {
            self.put(code, format_args!("{number:.6}"));
        }
    }

    fn section(&mut self, name: &str) {
        self.put(0, "SECTION");
        self.put(2, name);
    }

    /// Begins an object with the next handle; the handle.
    fn object(&mut self, kind: &str, owner: u32) -> u32 {
        let handle = self.next_handle;
        self.next_handle += 1;
        self.put(0, kind);
        self.put(5, format_args!("{handle:X}"));
        self.put(330, format_args!("{owner:X}"));
        handle
    }

    fn entity(&mut self, kind: &str, layer: &str) {
        self.object(kind, MODEL_SPACE);
        self.put(100, "AcDbEntity");
        self.put(8, layer);
    }
}

/// Writes a slice.
pub(crate) fn write(slice: &SliceObject, title: &str) -> String {
    let extent = Extent::of(slice);
    let mut body = Dxf { text: String::new(), next_handle: FIRST_HANDLE };
    entities(&mut body, slice, extent.unwrap_or(EMPTY_SLICE).letter_height());
    objects(&mut body);

    let mut file = Dxf { text: String::new(), next_handle: body.next_handle };
    let ascii: String = title.chars().map(|c| if c.is_ascii_graphic() { c } else { ' ' }).collect();
    file.put(999, format_args!("{ascii}; unit mm; {}", slice.id));
    header(&mut file, extent, slice.z);
    file.text.push_str(&tables_and_blocks(extent.unwrap_or(EMPTY_SLICE)));
    file.text.push_str(&body.text);
    file.put(0, "EOF");
    file.text
}

fn header(file: &mut Dxf, extent: Option<Extent>, z: f64) {
    // AutoCAD writes these for an empty drawing.
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
        file.numbers([(10, x), (20, y)]);
        if name.starts_with("$EXT") {
            file.numbers([(30, z)]);
        }
    }
    file.put(9, "$HANDSEED");
    let next_handle = file.next_handle;
    file.put(5, format_args!("{next_handle:X}"));
    file.put(0, "ENDSEC");
}

/// The first view shows the extent.
fn tables_and_blocks(Extent { min, max }: Extent) -> String {
    let [width, height] = [max[0] - min[0], max[1] - min[1]].map(|side| VIEW * side.max(1e-3));
    [
        ("{centre_x}", f64::midpoint(min[0], max[0])),
        ("{centre_y}", f64::midpoint(min[1], max[1])),
        ("{height}", height),
        ("{aspect}", width / height),
    ]
    .into_iter()
    .fold(TABLES_AND_BLOCKS.to_owned(), |text, (name, number)| text.replace(name, &format!("{number:.6}")))
}

fn entities(body: &mut Dxf, slice: &SliceObject, letter_height: f64) {
    body.section("ENTITIES");
    for polygon in &slice.polygons {
        polyline(body, "OUTER", &polygon.outer, slice.z, true);
        for hole in &polygon.holes {
            polyline(body, "HOLES", hole, slice.z, true);
        }
    }
    for line in &slice.contours {
        polyline(body, "ALPHA", &line.points, slice.z, false);
        if let Some(start) = line.points.first() {
            alpha_label(body, displayed(line.alpha), [start.0[0], start.0[1], slice.z], letter_height);
        }
    }
    body.put(0, "ENDSEC");
}

fn polyline(body: &mut Dxf, layer: &str, points: &[Pair], z: f64, closed: bool) {
    body.entity("LWPOLYLINE", layer);
    body.put(100, "AcDbPolyline");
    body.put(90, points.len());
    body.put(70, u8::from(closed));
    body.numbers([(38, z)]);
    for point in points {
        let [x, y] = point.0;
        body.numbers([(10, x), (20, y)]);
    }
}

/// A value of alpha, degrees, at the start of its line.
fn alpha_label(body: &mut Dxf, degrees: f64, [x, y, z]: [f64; 3], height: f64) {
    body.entity("TEXT", "ALPHA");
    body.put(100, "AcDbText");
    body.numbers([(10, x), (20, y), (30, z), (40, height)]);
    // %%d is the degree sign.
    body.put(1, format_args!("{degrees}%%d"));
    body.put(100, "AcDbText");
}

/// The section OBJECTS: the root dictionary with its one obligatory entry.
fn objects(body: &mut Dxf) {
    body.section("OBJECTS");
    let root = body.object("DICTIONARY", 0);
    body.put(100, "AcDbDictionary");
    body.put(281, 1);
    body.put(3, "ACAD_GROUP");
    let group = body.next_handle;
    body.put(350, format_args!("{group:X}"));
    body.object("DICTIONARY", root);
    body.put(100, "AcDbDictionary");
    body.put(281, 1);
    body.put(0, "ENDSEC");
}
