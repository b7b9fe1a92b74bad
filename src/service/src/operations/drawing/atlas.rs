//! Atlases: regions by their number of solutions, curves by their kind, special points, the working mode's domain.

use std::collections::BTreeMap;
use std::fmt::Write;

use crate::operations::drawing::dxf::{self, Layer, Sheet};
use crate::operations::drawing::extent::Extent;
use crate::operations::drawing::svg::{Heading, Page, path};
use crate::wire::atlas::{AtlasObject, CurveKindName, FaceObject, RegionObject, SpaceName};

/// The colours of the regions with the fewest and the most solutions, sRGB. Those between are equal steps apart.
const FEWEST: [u8; 3] = [0xf4, 0xf7, 0xfa];
const MOST: [u8; 3] = [0x5f, 0x9b, 0xd1];

/// The number of solutions stands in regions that are at least this part of the window.
const LABELLED: f64 = 0.004;

/// Distance of the lines that hatch the working mode's domain, as a part of the drawing's larger side.
const HATCH: f64 = 0.02;

/// The layer of special points, and the one of the working mode's domain.
const POINTS: &str = "POINTS";
const WORKING: &str = "WORKING";

/// How the curves of a kind are drawn.
struct CurveStyle {
    /// Colour in SVG.
    colour: &'static str,
    /// Lengths of dashes and gaps as parts of the drawing's larger side; none for a solid line.
    dashes: &'static [f64],
    /// Meaning of the curve.
    meaning: &'static str,
    /// Layer in DXF.
    layer: &'static str,
    /// Colour of the layer in AutoCAD's index.
    layer_colour: u8,
}

fn style(kind: CurveKindName) -> CurveStyle {
    let (colour, dashes, meaning, layer, layer_colour): (_, &[f64], _, _, _) = match kind {
        CurveKindName::LegOne => ("#8a1c5b", &[], "angles of leg I merge", "LEG_1", 6),
        CurveKindName::LegTwo => ("#00664b", &[0.012, 0.005], "leg II is level", "LEG_2", 3),
        CurveKindName::LegThree => ("#9a4300", &[0.004, 0.005], "leg III is level", "LEG_3", 30),
        CurveKindName::Parallel => ("#8a1c5b", &[], "det_P = 0", "PARALLEL", 6),
        CurveKindName::Constraint => {
            ("#4a4a4a", &[0.012, 0.004, 0.004, 0.004], "leg I is level", "CONSTRAINT", 8)
        }
    };
    CurveStyle { colour, dashes, meaning, layer, layer_colour }
}

/// Draws an atlas as SVG.
pub(crate) fn svg(atlas: &AtlasObject, title: &str) -> String {
    let extent = extent(atlas);
    let page = Page::around(extent);
    let mut contents = String::new();
    regions(&mut contents, atlas);
    working(&mut contents, atlas, &page);
    // Writing to a string cannot fail.
    for curve in &atlas.curves {
        let mut along = String::new();
        path(&mut along, &curve.points);
        let end = if curve.closed { "Z" } else { "" };
        let stroke = stroke(&style(curve.kind), &page);
        let _ = writeln!(contents, r#"<path d="{along}{end}" fill="none" {stroke}/>"#);
    }
    for point in &atlas.points {
        let [u, v] = point.at.0;
        let _ = writeln!(
            contents,
            r##"<circle cx="{u:.4}" cy="{:.4}" r="{:.4}" fill="white" stroke="#8a1c5b"><title>{}</title></circle>"##,
            0.0 - v,
            0.004 * page.size,
            point.kind.words()
        );
    }
    labels(&mut contents, atlas, &page, extent);
    legend(&mut contents, atlas, &page);
    let seen = match atlas.space {
        SpaceName::Platform => "base frame, y up: seen from below, as z points down",
        SpaceName::Joints => "u = rho2 - rho1, v = rho3 - rho1",
    };
    let figures =
        format!("tolerance {} mm; {} regions; {}", atlas.tolerance, atlas.regions.len(), atlas.machine.hash);
    page.write(&Heading { title, seen, figures: &figures, axes: atlas.coordinates }, &contents)
}

/// Draws an atlas as DXF. The regions with n solutions are closed polylines on the layer SOLUTIONS_n, with n as a text;
/// each kind of curves has a layer; special points are points on POINTS, and the working mode's domain is on WORKING.
pub(crate) fn dxf(atlas: &AtlasObject, title: &str) -> String {
    let extent = extent(atlas);
    let comment = format!("{title}; unit mm; tolerance {} mm; {}", atlas.tolerance, atlas.machine.hash);
    let sheet = Sheet { comment: &comment, extent: Some(extent), z: 0.0 };
    dxf::write(&sheet, &layers(atlas), |body| {
        let mut rings = |layer: &str, face: &FaceObject| {
            for ring in std::iter::once(&face.outer).chain(&face.holes) {
                body.polyline(layer, ring, 0.0, true);
            }
        };
        for region in &atlas.regions {
            rings(&layer_of(region), &region.face);
        }
        for face in &atlas.working.regions {
            rings(WORKING, face);
        }
        for region in &atlas.regions {
            let [u, v] = region.face.label.0;
            body.text(&layer_of(region), [u, v, 0.0], extent.letter_height(), region.solutions);
        }
        for curve in &atlas.curves {
            body.polyline(style(curve.kind).layer, &curve.points, 0.0, curve.closed);
        }
        for point in &atlas.points {
            body.point(POINTS, point.at.0, 0.0);
        }
    })
}

/// The extent of a drawing is the window.
fn extent(atlas: &AtlasObject) -> Extent {
    let (u, v) = (atlas.window.u.0, atlas.window.v.0);
    Extent { min: [u[0], v[0]], max: [u[1], v[1]] }
}

fn layer_of(region: &RegionObject) -> String {
    format!("SOLUTIONS_{}", region.solutions)
}

/// The layers that the drawing uses, each once.
fn layers(atlas: &AtlasObject) -> Vec<Layer> {
    let regions = atlas.regions.iter().map(|region| (layer_of(region), 5));
    let curves = atlas.curves.iter().map(|curve| style(curve.kind));
    let curves = curves.map(|style| (style.layer.to_owned(), style.layer_colour));
    let others = [(POINTS.to_owned(), 1), (WORKING.to_owned(), 4)];
    let used: BTreeMap<String, u8> = regions.chain(curves).chain(others).collect();
    used.into_iter().map(|(name, colour)| Layer { name, colour }).collect()
}

/// The colours of all numbers of solutions.
fn colours(atlas: &AtlasObject) -> BTreeMap<usize, String> {
    let mut colours: BTreeMap<usize, String> =
        atlas.regions.iter().map(|region| (region.solutions, String::new())).collect();
    let last = f64::from(u32::try_from(colours.len().saturating_sub(1)).unwrap_or(u32::MAX)).max(1.0);
    for (place, colour) in (0_u32..).zip(colours.values_mut()) {
        let part = f64::from(place) / last;
        let [r, g, b] = [0, 1, 2].map(|channel| {
            let (fewest, most) = (f64::from(FEWEST[channel]), f64::from(MOST[channel]));
            (fewest + part * (most - fewest)).round()
        });
        *colour = format!("rgb({r},{g},{b})");
    }
    colours
}

fn regions(svg: &mut String, atlas: &AtlasObject) {
    let colours = colours(atlas);
    for RegionObject { solutions, face } in &atlas.regions {
        let colour = colours.get(solutions).map(String::as_str).unwrap_or_default();
        let (outline, area, error) = (outline(face), face.area, face.area_error);
        let _ = writeln!(
            svg,
            "<path d=\"{outline}\" fill=\"{colour}\" fill-rule=\"evenodd\" stroke=\"none\">\
             <title>{solutions} solutions, {area:.1} ± {error:.1} mm²</title></path>"
        );
    }
}

fn working(svg: &mut String, atlas: &AtlasObject, page: &Page) {
    let step = HATCH * page.size;
    let _ = writeln!(
        svg,
        "<defs><pattern id=\"working\" patternUnits=\"userSpaceOnUse\" width=\"{step:.4}\" height=\"{step:.4}\" \
         patternTransform=\"rotate(45)\"><path d=\"M0 0V{step:.4}\" stroke=\"#202020\" stroke-opacity=\"0.35\"/>\
         </pattern></defs>"
    );
    for face in &atlas.working.regions {
        let outline = outline(face);
        let _ = writeln!(
            svg,
            "<path d=\"{outline}\" fill=\"url(#working)\" fill-rule=\"evenodd\">\
             <title>a solution in the working mode</title></path>"
        );
    }
}

/// The numbers of solutions, in regions that have room for them.
fn labels(svg: &mut String, atlas: &AtlasObject, page: &Page, extent: Extent) {
    let whole = (extent.max[0] - extent.min[0]) * (extent.max[1] - extent.min[1]);
    for RegionObject { solutions, face } in &atlas.regions {
        let [u, v] = face.label.0;
        if face.area >= LABELLED * whole {
            let y = 0.35 * page.letters - v;
            let _ = writeln!(
                svg,
                "<text x=\"{u:.4}\" y=\"{y:.4}\" text-anchor=\"middle\" stroke=\"white\" paint-order=\"stroke\">\
                 {solutions}</text>"
            );
        }
    }
}

/// The kinds of the curves, and the hatching, in one line below the axes.
fn legend(svg: &mut String, atlas: &AtlasObject, page: &Page) {
    let mut shown: Vec<CurveKindName> = Vec::new();
    for curve in &atlas.curves {
        if !shown.contains(&curve.kind) {
            shown.push(curve.kind);
        }
    }
    let ([mut x, y], letters) = (page.footer(), page.letters);
    for style in shown.into_iter().map(style) {
        let (line, stroke) = (y - 0.3 * letters, stroke(&style, page));
        let _ = writeln!(
            svg,
            r#"<path d="M{x:.4} {line:.4}h{:.4}" fill="none" {stroke}/><text x="{:.4}" y="{y:.4}">{}</text>"#,
            2.5 * letters,
            x + 3.0 * letters,
            style.meaning
        );
        x += 14.0 * letters;
    }
    if !atlas.working.regions.is_empty() {
        let _ = writeln!(svg, r#"<text x="{x:.4}" y="{y:.4}">hatched: working mode</text>"#);
    }
}

fn stroke(style: &CurveStyle, page: &Page) -> String {
    let dashes: Vec<String> = style.dashes.iter().map(|part| format!("{:.4}", part * page.size)).collect();
    let dashes = if dashes.is_empty() {
        String::new()
    } else {
        format!(r#" stroke-dasharray="{}""#, dashes.join(" "))
    };
    format!(r#"stroke="{}"{dashes}"#, style.colour)
}

/// The rings of a face as a path of SVG.
fn outline(face: &FaceObject) -> String {
    let mut outline = String::new();
    for ring in std::iter::once(&face.outer).chain(&face.holes) {
        path(&mut outline, ring);
        outline.push('Z');
    }
    outline
}
