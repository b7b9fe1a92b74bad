//! Drawings as DXF of AutoCAD 2000 (AC1015), which every CAD program reads: polylines, points and texts on layers at
//! one height. Units are mm.
//!
//! A DXF file is a sequence of pairs of lines: a group code and its value. Objects have handles, hexadecimal numbers.

use std::fmt::{Display, Write};

use crate::operations::drawing::extent::{EMPTY, Extent};
use crate::wire::fixed_array::Pair;

/// The sections TABLES and BLOCKS, which a drawing of AC1015 must have. The names in braces stand for the first view
/// and for the layers.
const TABLES_AND_BLOCKS: &str = include_str!("dxf/tables_and_blocks.dxf");

/// The handle of the model space in [`TABLES_AND_BLOCKS`]: it owns the entities.
const MODEL_SPACE: u32 = 0x15;

/// The handle of the table of layers in [`TABLES_AND_BLOCKS`].
const LAYER_TABLE: u32 = 0x7;

/// The first handle that [`TABLES_AND_BLOCKS`] does not use.
const FIRST_HANDLE: u32 = 0x1B;

/// Height of the first view as a multiple of the drawing's.
const VIEW: f64 = 1.2;

/// A layer of a drawing.
pub(crate) struct Layer {
    /// Its name: capital letters, digits and underscores.
    pub name: String,
    /// Its colour in AutoCAD's index.
    pub colour: u8,
}

/// What stands on the sheet: its title, its extent if it is not empty, and its height.
pub(crate) struct Sheet<'a> {
    /// The comment at the beginning of the file.
    pub comment: &'a str,
    /// The extent of what is drawn; none if nothing is.
    pub extent: Option<Extent>,
    /// The height of everything, mm.
    pub z: f64,
}

/// The text of a file, or of a part of it.
pub(crate) struct Dxf {
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

    fn layer(&mut self, layer: &Layer) {
        self.object("LAYER", LAYER_TABLE);
        self.put(100, "AcDbSymbolTableRecord");
        self.put(100, "AcDbLayerTableRecord");
        self.put(2, &layer.name);
        self.put(70, 0);
        self.put(62, layer.colour);
        self.put(6, "Continuous");
    }

    /// Adds a polyline at a height.
    pub(crate) fn polyline(&mut self, layer: &str, points: &[Pair], z: f64, closed: bool) {
        self.entity("LWPOLYLINE", layer);
        self.put(100, "AcDbPolyline");
        self.put(90, points.len());
        self.put(70, u8::from(closed));
        self.numbers([(38, z)]);
        for point in points {
            let [x, y] = point.0;
            self.numbers([(10, x), (20, y)]);
        }
    }

    /// Adds a point.
    pub(crate) fn point(&mut self, layer: &str, [x, y]: [f64; 2], z: f64) {
        self.entity("POINT", layer);
        self.put(100, "AcDbPoint");
        self.numbers([(10, x), (20, y), (30, z)]);
    }

    /// Adds a text of ASCII that begins at a point; %%d is the degree sign.
    pub(crate) fn text(&mut self, layer: &str, [x, y, z]: [f64; 3], height: f64, text: impl Display) {
        self.entity("TEXT", layer);
        self.put(100, "AcDbText");
        self.numbers([(10, x), (20, y), (30, z), (40, height)]);
        self.put(1, text);
        self.put(100, "AcDbText");
    }
}

/// Writes a drawing. `draw` adds the entities.
pub(crate) fn write(sheet: &Sheet<'_>, layers: &[Layer], draw: impl FnOnce(&mut Dxf)) -> String {
    let mut table = Dxf { text: String::new(), next_handle: FIRST_HANDLE };
    for layer in layers {
        table.layer(layer);
    }
    let mut body = Dxf { text: String::new(), next_handle: table.next_handle };
    body.section("ENTITIES");
    draw(&mut body);
    body.put(0, "ENDSEC");
    objects(&mut body);

    let mut file = Dxf { text: String::new(), next_handle: body.next_handle };
    let ascii: String = sheet.comment.chars().map(|c| if c.is_ascii_graphic() { c } else { ' ' }).collect();
    file.put(999, ascii);
    header(&mut file, sheet.extent, sheet.z);
    file.text.push_str(&tables_and_blocks(sheet.extent.unwrap_or(EMPTY), layers.len(), &table.text));
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

/// The first view shows the extent. Beside the layers of the drawing there is layer 0.
fn tables_and_blocks(Extent { min, max }: Extent, layers: usize, table: &str) -> String {
    let [width, height] = [max[0] - min[0], max[1] - min[1]].map(|side| VIEW * side.max(1e-3));
    let text =
        TABLES_AND_BLOCKS.replace("{layer_count}", &(layers + 1).to_string()).replace("{layers}", table);
    [
        ("{centre_x}", f64::midpoint(min[0], max[0])),
        ("{centre_y}", f64::midpoint(min[1], max[1])),
        ("{height}", height),
        ("{aspect}", width / height),
    ]
    .into_iter()
    .fold(text, |text, (name, number)| text.replace(name, &format!("{number:.6}")))
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
