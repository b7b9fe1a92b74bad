//! Slices of workspaces and of regions of origins.

use std::fmt::Write;

use crate::operations::drawing::dxf::{self, Layer, Sheet};
use crate::operations::drawing::extent::{EMPTY, Extent};
use crate::operations::drawing::svg::{Heading, Page, path};
use crate::wire::slice::SliceObject;
use crate::wire::workspace::FrameName;

/// The layers of outlines, holes and lines of constant alpha, with their colours in AutoCAD's index.
const LAYERS: [(&str, u8); 3] = [(OUTER, 5), (HOLES, 1), (ALPHA, 8)];
const OUTER: &str = "OUTER";
const HOLES: &str = "HOLES";
const ALPHA: &str = "ALPHA";

/// Draws a slice as SVG.
pub(crate) fn svg(slice: &SliceObject, title: &str) -> String {
    let page = Page::around(extent(slice).unwrap_or(EMPTY));
    let mut contents = String::new();
    let mut outline = String::new();
    for polygon in &slice.polygons {
        for ring in std::iter::once(&polygon.outer).chain(&polygon.holes) {
            path(&mut outline, ring);
            outline.push('Z');
        }
    }
    // Writing to a string cannot fail.
    let _ = writeln!(
        contents,
        r##"<path d="{outline}" fill="#56b4e9" fill-opacity="0.45" fill-rule="evenodd" stroke="#0072b2"/>"##
    );
    for line in &slice.contours {
        let mut along = String::new();
        path(&mut along, &line.points);
        let alpha = displayed(line.alpha);
        let _ = writeln!(
            contents,
            r##"<path d="{along}" fill="none" stroke="#d55e00"><title>alpha = {alpha}°</title></path>"##
        );
        if let Some(&[x, y]) = line.points.first().map(|point| &point.0) {
            let _ = writeln!(contents, r##"<text x="{x:.2}" y="{:.2}" fill="#d55e00">{alpha}°</text>"##, -y);
        }
    }
    let seen = match slice.frame {
        FrameName::Base => "base frame, y up: seen from below, as z points down",
        FrameName::Part => "part frame, y up: seen from above",
    };
    let figures = format!("area {:.3} mm²; {}", slice.area, slice.id);
    page.write(&Heading { title, seen, figures: &figures, axes: ["x", "y"] }, &contents)
}

/// Draws a slice as DXF: closed polylines at the height of the slice, and the values of alpha as text.
pub(crate) fn dxf(slice: &SliceObject, title: &str) -> String {
    let extent = extent(slice);
    let letters = extent.unwrap_or(EMPTY).letter_height();
    let comment = format!("{title}; unit mm; {}", slice.id);
    let layers = LAYERS.map(|(name, colour)| Layer { name: name.to_owned(), colour });
    let z = slice.z;
    dxf::write(&Sheet { comment: &comment, extent, z }, &layers, |body| {
        for polygon in &slice.polygons {
            body.polyline(OUTER, &polygon.outer, z, true);
            for hole in &polygon.holes {
                body.polyline(HOLES, hole, z, true);
            }
        }
        for line in &slice.contours {
            body.polyline(ALPHA, &line.points, z, false);
            if let Some(&[x, y]) = line.points.first().map(|point| &point.0) {
                body.text(ALPHA, [x, y, z], letters, format_args!("{}%%d", displayed(line.alpha)));
            }
        }
    })
}

/// The extent of the polygons; none if the slice is empty.
fn extent(slice: &SliceObject) -> Option<Extent> {
    Extent::of(slice.polygons.iter().flat_map(|polygon| &polygon.outer).map(|point| point.0))
}

/// The value of a line of constant alpha, degrees, without the last digits: they are rounding errors of radians.
fn displayed(degrees: f64) -> f64 {
    (degrees * 1e6).round() / 1e6
}
