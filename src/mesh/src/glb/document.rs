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
    let views = views(&mut root, layout);
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
    let object = root.push(gltf_json::Mesh {
        extensions: None,
        extras: extras(&json!({ "palette": mesh.palette() }))?,
        name: Some(options.name.clone()),
        primitives,
        weights: None,
    });
    let node = root.push(Node {
        mesh: Some(object),
        name: Some(options.name.clone()),
        translation: Some(placement.translation),
        ..Node::default()
    });
    for scene in &mut root.scenes {
        scene.nodes.push(node);
    }
    Ok(root)
}

fn primitive(
    root: &mut Root,
    [vertices, indices]: [Index<View>; 2],
    layout: &Layout,
    range: &PrimitiveLayout,
) -> Primitive {
    let first = (range.vertices.start * STRIDE) as u64;
    let mut attribute = |offset: u64, bounds: Option<[[f32; 3]; 2]>| {
        let [min, max] = bounds.map_or([None, None], |corners| corners.map(|corner| Some(json!(corner))));
        let accessor = accessor(vertices, range.vertices.len(), ComponentType::F32, Type::Vec3);
        root.push(Accessor { byte_offset: Some((first + offset).into()), min, max, ..accessor })
    };
    let position = attribute(0, Some(range.bounds));
    let normal = attribute(12, None);
    let width = if layout.short_indices() { ComponentType::U16 } else { ComponentType::U32 };
    let from = range.indices.start as u64 * layout.index_size();
    let indices = root.push(Accessor {
        byte_offset: Some(from.into()),
        ..accessor(indices, range.indices.len(), width, Type::Scalar)
    });
    Primitive {
        attributes: [(Valid(Semantic::Positions), position), (Valid(Semantic::Normals), normal)].into(),
        extensions: None,
        extras: None,
        indices: Some(indices),
        material: None,
        mode: Valid(Mode::Triangles),
        targets: None,
    }
}

/// The two views of the buffer: vertices and indices.
fn views(root: &mut Root, layout: &Layout) -> [Index<View>; 2] {
    let buffer = root.push(Buffer {
        byte_length: layout.bytes().into(),
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
    let vertices = view(0, layout.vertex_bytes(), Some(Stride(STRIDE)), Target::ArrayBuffer);
    let indices = view(layout.vertex_bytes(), layout.index_bytes(), None, Target::ElementArrayBuffer);
    [vertices, indices]
}

fn accessor(view: Index<View>, count: usize, component: ComponentType, type_: Type) -> Accessor {
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

/// The material of a tag: its name and colour, rough. It is one-sided, because the surface is closed.
fn material(swatch: &Swatch) -> Material {
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

fn extras(value: &Value) -> serde_json::Result<Extras> {
    if value.is_null() { Ok(None) } else { to_raw_value(value).map(Some) }
}
