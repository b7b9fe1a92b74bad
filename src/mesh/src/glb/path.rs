//! A path as lines.

use std::io::{self, BufWriter, Write};

use gltf_json::accessor::{ComponentType, Type};
use gltf_json::buffer::View;
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked::Valid;
use gltf_json::{Accessor, Index, Root};

use super::document::{accessor, bare, bounded, empty, extras, material, place, views};
use super::layout::bounds;
use super::options::Options;
use super::placement::Placement;
use super::write_head;
use crate::palette::linear;
use crate::path::{Path, Stroke};
use crate::{Bounds, Swatch};

/// Bytes of one vertex: three floats of position, three 16-bit channels of colour, two of padding.
const STRIDE: usize = 20;
/// Bytes of one segment: two 32-bit indices.
const SEGMENT: u64 = 8;

/// Writes the path as a GLB: one primitive of lines with vertex colours for the coloured segments, and one of lines
/// with a material for the plain ones. A path without segments becomes a scene without nodes.
///
/// Each primitive's material has the name of its segments.
///
/// # Units
///
/// The path is in millimetres; the file is in metres with Y up.
///
/// # Errors
///
/// - The error of `out`.
/// - [`io::ErrorKind::FileTooLarge`]: the file would be longer than 4 GiB.
///
/// # References
///
/// [glTF 2.0](https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html), section 3.7.2: topology types of lines.
///
/// # Examples
///
/// ```
/// use verne_mesh::glb::{self, Options, Up};
/// use verne_mesh::{ColourScale, PathBuilder, Stroke, Swatch};
///
/// let mut builder = PathBuilder::new(2, 100);
/// builder.push([0.0, 0.0, 300.0], 0.2, Stroke::None)?;
/// builder.push([50.0, 0.0, 300.0], 0.1, Stroke::Coloured)?;
/// let plain = Swatch { name: "rapid".to_owned(), rgb: [128; 3] };
/// let path = builder.finish("feed".to_owned(), plain, ColourScale { least: 0.0, greatest: 0.5 });
/// let options = Options { name: "path".to_owned(), up: Up::PositiveZ, extras: serde_json::Value::Null };
/// let mut file = Vec::new();
/// glb::write_path(&path, &options, &mut file)?;
/// assert!(file.starts_with(b"glTF"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_path(path: &Path, options: &Options, out: impl Write) -> io::Result<()> {
    let mut out = BufWriter::new(out);
    match path.bounds() {
        Some(bounds) if count(path, Stroke::Coloured) + count(path, Stroke::Plain) > 0 => {
            write_lines(path, bounds, options, &mut out)?;
        }
        _ => write_head(&empty(options)?, None, &mut out)?,
    }
    out.flush()
}

fn write_lines(path: &Path, bounds: Bounds, options: &Options, out: &mut impl Write) -> io::Result<()> {
    let placement = Placement::new(options.up, bounds);
    let vertices = (path.points().len() * STRIDE) as u64;
    let indices = SEGMENT * (count(path, Stroke::Coloured) + count(path, Stroke::Plain));
    let document = document(path, options, &placement, [vertices, indices])?;
    write_head(&document, Some(vertices + indices), out)?;
    for (point, value) in path.points().iter().zip(path.values()) {
        for coordinate in placement.position(*point) {
            out.write_all(&coordinate.to_le_bytes())?;
        }
        for channel in path.scale.colour(*value).map(linear) {
            out.write_all(&sixteen_bits(channel).to_le_bytes())?;
        }
        out.write_all(&[0; 2])?;
    }
    for stroke in [Stroke::Coloured, Stroke::Plain] {
        for end in ends(path, stroke) {
            out.write_all(&(end - 1).to_le_bytes())?;
            out.write_all(&end.to_le_bytes())?;
        }
    }
    Ok(())
}

/// Indices of the points at which the segments of a kind end.
fn ends(path: &Path, stroke: Stroke) -> impl Iterator<Item = u32> {
    // A file with more points than 32 bits can count is too long, and was refused.
    (0_u32..).zip(path.strokes()).filter(move |(_, of_point)| **of_point == stroke).map(|(index, _)| index)
}

fn count(path: &Path, stroke: Stroke) -> u64 {
    ends(path, stroke).count() as u64
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 65535")]
fn sixteen_bits(channel: f64) -> u16 {
    (channel.clamp(0.0, 1.0) * 65_535.0).round() as u16
}

fn document(
    path: &Path,
    options: &Options,
    placement: &Placement,
    bytes: [u64; 2],
) -> serde_json::Result<Root> {
    let mut root = empty(options)?;
    let [vertices, indices] = views(&mut root, STRIDE, bytes);
    let points = path.points().len();
    let extent = bounds(path.points().iter().map(|point| placement.position(*point)));
    let position = accessor(vertices, points, ComponentType::F32, Type::Vec3);
    let position = root.push(bounded(position, extent));
    let coloured = Swatch { name: path.coloured.clone(), rgb: [255; 3] };
    let mut primitives = Vec::new();
    let mut from = 0;
    for (stroke, swatch) in [(Stroke::Coloured, &coloured), (Stroke::Plain, &path.plain)] {
        let segments = count(path, stroke);
        if segments == 0 {
            continue;
        }
        let mut attributes = vec![(Valid(Semantic::Positions), position)];
        if stroke == Stroke::Coloured {
            let colours = accessor(vertices, points, ComponentType::U16, Type::Vec3);
            let colours = Accessor { byte_offset: Some(12_u64.into()), normalized: true, ..colours };
            attributes.push((Valid(Semantic::Colors(0)), root.push(colours)));
        }
        primitives.push(Primitive {
            attributes: attributes.into_iter().collect(),
            indices: Some(segment_indices(&mut root, indices, from, segments)),
            material: Some(root.push(material(swatch))),
            ..bare(Mode::Lines)
        });
        from += SEGMENT * segments;
    }
    place(&mut root, primitives, extras(&serde_json::Value::Null)?, options, placement);
    Ok(root)
}

fn segment_indices(root: &mut Root, view: Index<View>, from: u64, segments: u64) -> Index<Accessor> {
    let indices = usize::try_from(2 * segments).unwrap_or(usize::MAX);
    let accessor = accessor(view, indices, ComponentType::U32, Type::Scalar);
    root.push(Accessor { byte_offset: Some(from.into()), ..accessor })
}
