//! The JSON chunk.

use gltf_json::accessor::{ComponentType, GenericComponentType, Type};
use gltf_json::buffer::{Stride, Target, View};
use gltf_json::material::{PbrMetallicRoughness, StrengthFactor};
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked::Valid;
use gltf_json::{Accessor, Asset, Buffer, Extras, Index, Material, Node, Root, Scene};
use serde_json::value::to_raw_value;
use serde_json::{Value, json};

use super::Options;
use super::layout::{Layout, STRIDE};
use super::placement::Placement;
use crate::Mesh;

/// A scene of nothing.
pub(super) fn empty(options: &Options) -> serde_json::Result<Root> {
    let mut root =
        Root { asset: Asset { generator: Some("verne".to_owned()), ..Asset::default() }, ..Root::default() };
    let scene = Scene { extensions: None, extras: extras(&options.extras)?, name: None, nodes: Vec::new() };
    root.scene = Some(root.push(scene));
    Ok(root)
}

/// A scene of one node that holds the mesh.
pub(super) fn of(
    mesh: &Mesh,
    options: &Options,
    placement: &Placement,
    layout: &Layout,
) -> serde_json::Result<Root> {
    let mut root = empty(options)?;
    let primitive = primitive(&mut root, placement, layout);
    let object = root.push(gltf_json::Mesh {
        extensions: None,
        extras: extras(&json!({ "palette": mesh.palette() }))?,
        name: Some(options.name.clone()),
        primitives: vec![primitive],
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

fn primitive(root: &mut Root, placement: &Placement, layout: &Layout) -> Primitive {
    let [vertices, indices] = views(root, layout);
    let mut attribute = |offset: u64, component, type_, normalized| {
        root.push(Accessor {
            byte_offset: Some(offset.into()),
            normalized,
            ..accessor(vertices, layout.vertices, component, type_)
        })
    };
    let position = attribute(0, ComponentType::F32, Type::Vec3, false);
    let normal = attribute(12, ComponentType::F32, Type::Vec3, false);
    let colour = attribute(24, ComponentType::U8, Type::Vec4, true);
    let tag = attribute(28, ComponentType::U8, Type::Scalar, false);
    let [min, max] = placement.bounds.map(|corner| Some(json!(corner)));
    let described = &mut root.accessors[position.value()];
    (described.min, described.max) = (min, max);
    let width = if layout.short_indices() { ComponentType::U16 } else { ComponentType::U32 };
    Primitive {
        attributes: [
            (Valid(Semantic::Positions), position),
            (Valid(Semantic::Normals), normal),
            (Valid(Semantic::Colors(0)), colour),
            (Valid(Semantic::Extras("TAG".to_owned())), tag),
        ]
        .into(),
        extensions: None,
        extras: None,
        indices: Some(root.push(accessor(indices, layout.indices, width, Type::Scalar))),
        material: Some(root.push(material())),
        mode: Valid(Mode::Triangles),
        targets: None,
    }
}

/// The buffer's two parts: vertices and indices.
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

/// White and rough: the vertices' colours are all there is to see. One-sided, since the surface is closed.
fn material() -> Material {
    Material {
        pbr_metallic_roughness: PbrMetallicRoughness {
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
