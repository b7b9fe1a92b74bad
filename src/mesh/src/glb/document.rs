//! The JSON chunk.

use gltf_json::accessor::{ComponentType, GenericComponentType, Type};
use gltf_json::buffer::{Stride, Target, View};
use gltf_json::material::{PbrBaseColorFactor, PbrMetallicRoughness, StrengthFactor};
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked::Valid;
use gltf_json::{Accessor, Asset, Buffer, Extras, Index, Material, Node, Root, Scene};
use serde_json::value::to_raw_value;
use serde_json::{Value, json};

use super::layout::{Layout, PrimitiveLayout, STRIDE};
use super::options::Options;
use super::placement::Placement;
use crate::{Mesh, Swatch};

/// An empty scene.
pub(super) fn empty(options: &Options) -> serde_json::Result<Root> {
    let mut root =
        Root { asset: Asset { generator: Some("verne".to_owned()), ..Asset::default() }, ..Root::default() };
    let scene = Scene { extensions: None, extras: extras(&options.extras)?, name: None, nodes: Vec::new() };
    root.scene = Some(root.push(scene));
    Ok(root)
}

/// A scene of one node with the mesh: for each tag that occurs a primitive with its own material.
pub(super) fn of(
    mesh: &Mesh,
    options: &Options,
    placement: &Placement,
    layout: &Layout,
) -> serde_json::Result<Root> {
    let mut root = empty(options)?;
    let views = views(&mut root, STRIDE, [layout.vertex_bytes(), layout.index_bytes()]);
    let mut primitives = Vec::with_capacity(layout.primitives.len());
    for range in &layout.primitives {
        let swatch = &mesh.palette()[usize::from(range.tag)];
        let material = root.push(material(swatch));
        let extras = extras(&json!({ "tag": range.tag }))?;
        primitives.push(Primitive {
            material: Some(material),
            extras,
            ..primitive(&mut root, views, layout, range)
        });
    }
    let palette = extras(&json!({ "palette": mesh.palette() }))?;
    place(&mut root, primitives, palette, options, placement);
    Ok(root)
}

/// Puts a node with the primitives into the scene.
pub(super) fn place(
    root: &mut Root,
    primitives: Vec<Primitive>,
    extras: Extras,
    options: &Options,
    placement: &Placement,
) {
    let name = Some(options.name.clone());
    let object = root.push(gltf_json::Mesh {
        extensions: None,
        extras,
        name: name.clone(),
        primitives,
        weights: None,
    });
    let translation = Some(placement.translation);
    let node = root.push(Node { mesh: Some(object), name, translation, ..Node::default() });
    for scene in &mut root.scenes {
        scene.nodes.push(node);
    }
}

fn primitive(
    root: &mut Root,
    [vertices, indices]: [Index<View>; 2],
    layout: &Layout,
    range: &PrimitiveLayout,
) -> Primitive {
    let first = (range.vertices.start * STRIDE) as u64;
    let mut attribute = |offset: u64, bounds: Option<[[f32; 3]; 2]>| {
        let accessor = accessor(vertices, range.vertices.len(), ComponentType::F32, Type::Vec3);
        let byte_offset = Some((first + offset).into());
        root.push(Accessor {
            byte_offset,
            ..bounds.map_or(accessor.clone(), |bounds| bounded(accessor, bounds))
        })
    };
    let position = attribute(0, Some(range.bounds));
    let normal = attribute(12, None);
    let width = if layout.short_indices() { ComponentType::U16 } else { ComponentType::U32 };
    let from = range.indices.start as u64 * layout.index_size();
    let indices = root.push(Accessor {
        byte_offset: Some(from.into()),
        ..accessor(indices, range.indices.len(), width, Type::Scalar)
    });
    let attributes = [(Valid(Semantic::Positions), position), (Valid(Semantic::Normals), normal)];
    Primitive { attributes: attributes.into(), indices: Some(indices), ..bare(Mode::Triangles) }
}

/// A primitive without attributes.
pub(super) fn bare(mode: Mode) -> Primitive {
    Primitive {
        attributes: [].into(),
        extensions: None,
        extras: None,
        indices: None,
        material: None,
        mode: Valid(mode),
        targets: None,
    }
}

/// The two views of the buffer: vertices of `stride` bytes each, and indices; of both the number of bytes.
pub(super) fn views(root: &mut Root, stride: usize, [vertices, indices]: [u64; 2]) -> [Index<View>; 2] {
    let buffer = root.push(Buffer {
        byte_length: (vertices + indices).into(),
        name: None,
        uri: None,
        extensions: None,
        extras: None,
    });
    let mut view = |offset: u64, length: u64, stride, target| {
        root.push(View {
            buffer,
            byte_length: length.into(),
            byte_offset: Some(offset.into()),
            byte_stride: stride,
            name: None,
            target: Some(Valid(target)),
            extensions: None,
            extras: None,
        })
    };
    [
        view(0, vertices, Some(Stride(stride)), Target::ArrayBuffer),
        view(vertices, indices, None, Target::ElementArrayBuffer),
    ]
}

/// The accessor with the least and the greatest of each coordinate.
pub(super) fn bounded(accessor: Accessor, bounds: [[f32; 3]; 2]) -> Accessor {
    let [min, max] = bounds.map(|corner| Some(json!(corner)));
    Accessor { min, max, ..accessor }
}

pub(super) fn accessor(view: Index<View>, count: usize, component: ComponentType, type_: Type) -> Accessor {
    Accessor {
        buffer_view: Some(view),
        byte_offset: None,
        count: count.into(),
        component_type: Valid(GenericComponentType(component)),
        extensions: None,
        extras: None,
        type_: Valid(type_),
        min: None,
        max: None,
        name: None,
        normalized: false,
        sparse: None,
    }
}

/// A material with the name and colour of a swatch, rough. It is one-sided, because surfaces are closed.
pub(super) fn material(swatch: &Swatch) -> Material {
    let [red, green, blue] = swatch.linear();
    Material {
        name: Some(swatch.name.clone()),
        pbr_metallic_roughness: PbrMetallicRoughness {
            base_color_factor: PbrBaseColorFactor([red, green, blue, 1.0]),
            metallic_factor: StrengthFactor(0.0),
            roughness_factor: StrengthFactor(0.8),
            ..PbrMetallicRoughness::default()
        },
        ..Material::default()
    }
}

pub(super) fn extras(value: &Value) -> serde_json::Result<Extras> {
    if value.is_null() { Ok(None) } else { to_raw_value(value).map(Some) }
}
