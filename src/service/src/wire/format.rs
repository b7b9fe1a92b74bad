//! The formats of meshes and slices: their names in queries, as file extensions and as media types.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Format of a mesh: `glb`, binary glTF 2.0 (metres, Y up, the frame in `extras`, one primitive and one material for
/// each active constraint), for viewers; `stl`, binary (mm), for slicers and CAD; `ply`, binary (mm, double precision,
/// with the active constraint of each vertex; the faces are sorted by active constraint, and comments list the
/// constraints); `json` (mm, flat `positions` and `indices`), for scripts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub(crate) enum MeshFormat {
    /// Binary glTF 2.0.
    Glb,
    /// Binary STL.
    Stl,
    /// Binary PLY.
    Ply,
    /// JSON with flat arrays.
    Json,
}

impl MeshFormat {
    /// All of them; the first is preferred.
    pub(crate) const ALL: [Self; 4] = [Self::Glb, Self::Stl, Self::Ply, Self::Json];

    /// The media type.
    pub(crate) fn media(self) -> &'static str {
        match self {
            Self::Glb => "model/gltf-binary",
            Self::Stl => "model/stl",
            Self::Ply => "model/ply",
            Self::Json => "application/json",
        }
    }

    /// The name, which is also the extension.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Glb => "glb",
            Self::Stl => "stl",
            Self::Ply => "ply",
            Self::Json => "json",
        }
    }
}

/// Format of a slice: `json`; `svg`, a drawing; `dxf` (AC1015, mm), for CAD.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub(crate) enum SliceFormat {
    /// Polygons with holes.
    Json,
    /// A drawing.
    Svg,
    /// AutoCAD 2000, ASCII.
    Dxf,
}

impl SliceFormat {
    /// All of them; the first is preferred.
    pub(crate) const ALL: [Self; 3] = [Self::Json, Self::Svg, Self::Dxf];

    /// The media types, the one that is answered first.
    pub(crate) fn media(self) -> &'static [&'static str] {
        match self {
            Self::Json => &["application/json"],
            Self::Svg => &["image/svg+xml"],
            Self::Dxf => &["image/vnd.dxf", "application/dxf"],
        }
    }

    /// The name, which is also the extension.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Json => "json",
            Self::Svg => "svg",
            Self::Dxf => "dxf",
        }
    }
}
