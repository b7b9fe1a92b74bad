//! The requests of `/atlas`, in query strings, bodies and on the command line.

use clap::Args;
use serde::Deserialize;
use utoipa::{IntoParams, ToSchema};

use crate::wire::atlas::SpaceName;
use crate::wire::format::SliceFormat;
use crate::wire::machine_ref::{MachineRef, REFERENCE, reference_name};

/// Parameters of GET /atlas.
#[derive(Debug, Deserialize, IntoParams, Args)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct AtlasQuery {
    /// Name of the machine. On the command line it may also be the path of a machine file.
    #[serde(default = "reference_name")]
    #[arg(long, default_value = REFERENCE)]
    #[param(default = "verne")]
    pub machine: String,
    /// Plane of the atlas.
    #[serde(default)]
    #[arg(long, default_value = "platform")]
    #[param(inline)]
    pub space: SpaceName,
    /// Least u of the window, mm. The default window is ± L1, or ± the greatest stroke of the sliders.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = -1e7, maximum = 1e7, nullable = false)]
    pub u_min: Option<f64>,
    /// Greatest u of the window, mm.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = -1e7, maximum = 1e7, nullable = false)]
    pub u_max: Option<f64>,
    /// Least v of the window, mm.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = -1e7, maximum = 1e7, nullable = false)]
    pub v_min: Option<f64>,
    /// Greatest v of the window, mm.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = -1e7, maximum = 1e7, nullable = false)]
    pub v_max: Option<f64>,
    /// Greatest distance between a curve of the answer and the true curve, mm, from 1e-5 to 0.1 of the window's longer
    /// side. The default is a thousandth of that side, at most 1 mm.
    #[arg(long)]
    #[param(minimum = 0, maximum = 1e6, nullable = false)]
    pub tolerance: Option<f64>,
    /// Return the atlas in this format. It overrides Accept.
    #[arg(skip)]
    #[param(inline, nullable = false)]
    pub format: Option<SliceFormat>,
}

/// Parameters of POST /atlas.
#[derive(Debug, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct AtlasFormatQuery {
    /// Return the atlas in this format. It overrides Accept.
    #[param(inline, nullable = false)]
    pub format: Option<SliceFormat>,
}

/// A request for an atlas.
#[derive(Clone, Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = AtlasRequest)]
pub(crate) struct AtlasBody {
    /// The machine: the name of a published machine, or a machine object.
    #[serde(default)]
    pub machine: MachineRef,
    /// Plane of the atlas.
    #[serde(default)]
    pub space: SpaceName,
    /// Least u of the window, mm. The default window is ± L1, or ± the greatest stroke of the sliders.
    #[serde(default)]
    #[schema(minimum = -1e7, maximum = 1e7)]
    pub u_min: Option<f64>,
    /// Greatest u of the window, mm.
    #[serde(default)]
    #[schema(minimum = -1e7, maximum = 1e7)]
    pub u_max: Option<f64>,
    /// Least v of the window, mm.
    #[serde(default)]
    #[schema(minimum = -1e7, maximum = 1e7)]
    pub v_min: Option<f64>,
    /// Greatest v of the window, mm.
    #[serde(default)]
    #[schema(minimum = -1e7, maximum = 1e7)]
    pub v_max: Option<f64>,
    /// Greatest distance between a curve of the answer and the true curve, mm, from 1e-5 to 0.1 of the window's longer
    /// side. The default is a thousandth of that side, at most 1 mm.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e6)]
    pub tolerance: Option<f64>,
}

impl AtlasQuery {
    /// The request as the body of POST /atlas.
    pub(crate) fn into_body(self) -> AtlasBody {
        let Self { machine, space, u_min, u_max, v_min, v_max, tolerance, format: _ } = self;
        let machine = MachineRef::Name(machine);
        AtlasBody { machine, space, u_min, u_max, v_min, v_max, tolerance }
    }
}
