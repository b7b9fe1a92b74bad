//! What a drawing of AC1015 must have around its entities: tables, the blocks of model and paper space, and the root
//! dictionary.

use crate::operations::drawing::dxf::tags::Body;
use crate::operations::drawing::extent::Extent;

/// The block records of the two spaces, by their handles.
#[derive(Clone, Copy)]
pub(crate) struct Spaces {
    pub(crate) model: u32,
    pub(crate) paper: u32,
}

const MODEL: &str = "*Model_Space";
const PAPER: &str = "*Paper_Space";

/// Height of the first view, as a multiple of what it shows.
const VIEW: f64 = 1.2;

/// All nine tables. The first view shows the extent.
pub(crate) fn tables(body: &mut Body, layers: &[(&str, u8)], extent: Extent) -> Spaces {
    body.section("TABLES");
    table(body, "VPORT", 1, |body, table| viewport(body, table, extent));
    table(body, "LTYPE", 3, |body, table| {
        for name in ["ByBlock", "ByLayer", "Continuous"] {
            linetype(body, table, name);
        }
    });
    table(body, "LAYER", layers.len(), |body, table| {
        for &(name, colour) in layers {
            record(body, "LAYER", table, "AcDbLayerTableRecord", name);
            body.put(70, 0);
            body.put(62, colour);
            body.put(6, "Continuous");
        }
    });
    table(body, "STYLE", 1, text_style);
    table(body, "VIEW", 0, |_, _| ());
    table(body, "UCS", 0, |_, _| ());
    table(body, "APPID", 1, |body, table| {
        record(body, "APPID", table, "AcDbRegAppTableRecord", "ACAD");
        body.put(70, 0);
    });
    table(body, "DIMSTYLE", 1, |body, table| {
        body.put(100, "AcDbDimStyleTable");
        // The code 5 has another meaning in a dimension style.
        body.object_with(105, "DIMSTYLE", table);
        named(body, "AcDbDimStyleTableRecord", "Standard");
        body.put(70, 0);
    });
    let mut spaces = Spaces { model: 0, paper: 0 };
    table(body, "BLOCK_RECORD", 2, |body, table| {
        spaces.model = record(body, "BLOCK_RECORD", table, "AcDbBlockTableRecord", MODEL);
        spaces.paper = record(body, "BLOCK_RECORD", table, "AcDbBlockTableRecord", PAPER);
    });
    body.put(0, "ENDSEC");
    spaces
}

fn table(body: &mut Body, name: &str, records: usize, write: impl FnOnce(&mut Body, u32)) {
    body.put(0, "TABLE");
    body.put(2, name);
    let handle = body.handle(5, 0);
    body.put(100, "AcDbSymbolTable");
    body.put(70, records);
    write(body, handle);
    body.put(0, "ENDTAB");
}

/// Begins a record of a table; its handle.
fn record(body: &mut Body, kind: &str, table: u32, class: &str, name: &str) -> u32 {
    let handle = body.object(kind, table);
    named(body, class, name);
    handle
}

fn named(body: &mut Body, class: &str, name: &str) {
    body.put(100, "AcDbSymbolTableRecord");
    body.put(100, class);
    body.put(2, name);
}

fn viewport(body: &mut Body, table: u32, Extent { min, max }: Extent) {
    let [width, height] = [max[0] - min[0], max[1] - min[1]].map(|side| VIEW * side.max(1e-3));
    record(body, "VPORT", table, "AcDbViewportTableRecord", "*Active");
    body.put(70, 0);
    for (code, number) in [
        // The part of the window, its centre in the drawing, grid and snap.
        (10, 0.0),
        (20, 0.0),
        (11, 1.0),
        (21, 1.0),
        (12, f64::midpoint(min[0], max[0])),
        (22, f64::midpoint(min[1], max[1])),
        (13, 0.0),
        (23, 0.0),
        (14, 10.0),
        (24, 10.0),
        (15, 10.0),
        (25, 10.0),
        // Seen along z.
        (16, 0.0),
        (26, 0.0),
        (36, 1.0),
        (17, 0.0),
        (27, 0.0),
        (37, 0.0),
        // Height in the drawing, and width over height.
        (40, height),
        (41, width / height),
    ] {
        body.number(code, number);
    }
}

fn linetype(body: &mut Body, table: u32, name: &str) {
    record(body, "LTYPE", table, "AcDbLinetypeTableRecord", name);
    body.put(70, 0);
    body.put(3, if name == "Continuous" { "Solid line" } else { "" });
    // The alignment A, and no dashes.
    body.put(72, 65);
    body.put(73, 0);
    body.number(40, 0.0);
}

fn text_style(body: &mut Body, table: u32) {
    record(body, "STYLE", table, "AcDbTextStyleTableRecord", "Standard");
    body.put(70, 0);
    // No fixed height, as wide as the font, upright.
    for (code, number) in [(40, 0.0), (41, 1.0), (50, 0.0)] {
        body.number(code, number);
    }
    body.put(71, 0);
    body.number(42, 2.5);
    body.put(3, "txt");
    body.put(4, "");
}

/// The blocks of the two spaces. Entities of the model stand in their own section.
pub(crate) fn blocks(body: &mut Body, spaces: Spaces) {
    body.section("BLOCKS");
    for (name, record) in [(MODEL, spaces.model), (PAPER, spaces.paper)] {
        body.object("BLOCK", record);
        of_layer_0(body, name, "AcDbBlockBegin");
        body.put(2, name);
        body.put(70, 0);
        for code in [10, 20, 30] {
            body.number(code, 0.0);
        }
        body.put(3, name);
        body.put(1, "");
        body.object("ENDBLK", record);
        of_layer_0(body, name, "AcDbBlockEnd");
    }
    body.put(0, "ENDSEC");
}

fn of_layer_0(body: &mut Body, space: &str, class: &str) {
    body.put(100, "AcDbEntity");
    if space == PAPER {
        body.put(67, 1);
    }
    body.put(8, 0);
    body.put(100, class);
}

/// The root dictionary, with its one obligatory entry.
pub(crate) fn objects(body: &mut Body) {
    body.section("OBJECTS");
    let root = body.object("DICTIONARY", 0);
    body.put(100, "AcDbDictionary");
    body.put(281, 1);
    body.put(3, "ACAD_GROUP");
    body.put(350, format_args!("{:X}", body.next_handle()));
    body.object("DICTIONARY", root);
    body.put(100, "AcDbDictionary");
    body.put(281, 1);
    body.put(0, "ENDSEC");
}
