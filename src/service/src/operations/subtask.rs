//! Pieces of large questions: jobs of their own, whose results the answer is merged from.

use serde::{Deserialize, Serialize};

use crate::operations::dexterity_question::DexterityQuestion;
use crate::operations::family_question::FamilyQuestion;
use crate::operations::registry::Published;
use crate::operations::workspace_question::WorkspaceQuestion;
use crate::wire::dexterity::CanonicalDexterity;
use crate::wire::result_id::ResultId;
use crate::wire::workspace::CanonicalRequest;

/// Changes when the bytes do that a piece is kept as.
const LAYOUT: &[u8] = b"verne piece 1";

/// Seconds of one core that a slab is cut to, and the most slabs of a map.
const SLAB_COST: f64 = 2.0;
const SLABS: f64 = 64.0;

/// Part of a map's work that its volumes are, about.
const VOLUMES_SHARE: f64 = 0.2;

/// Part of the slabs' work up to `cut` of the way through the map, about: a layer has much to compute where the machine
/// reaches far, so in the middle, and nothing at the ends. As a parabola.
fn share(cut: f64) -> f64 {
    cut * cut * (3.0 - 2.0 * cut)
}

/// A piece of a question.
#[derive(Clone, Debug)]
pub(crate) enum Piece {
    /// A member of a family: unlike the workspace itself, one that cannot be computed is a result as well.
    Member(WorkspaceQuestion),
    /// One of `count` slabs of a dexterity map.
    Slab {
        /// The map.
        of: DexterityQuestion,
        /// Which slab, from 0.
        number: u32,
        /// How many there are.
        count: u32,
    },
    /// The volumes of a dexterity map.
    Volumes(DexterityQuestion),
}

/// A piece as text, without its machine.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum WrittenPiece {
    Member(CanonicalRequest),
    Slab { of: CanonicalDexterity, number: u32, count: u32 },
    Volumes(CanonicalDexterity),
}

impl Piece {
    /// The members of a family.
    pub(crate) fn of_family(family: &FamilyQuestion) -> Vec<Self> {
        family.members.iter().cloned().map(Self::Member).collect()
    }

    /// The slabs of a map, and its volumes.
    pub(crate) fn of_map(map: &DexterityQuestion) -> Vec<Self> {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 64")]
        let count = (map.cost() / SLAB_COST).clamp(1.0, SLABS) as u32;
        let slabs = (0..count).map(|number| Self::Slab { of: map.clone(), number, count });
        slabs.chain([Self::Volumes(map.clone())]).collect()
    }

    /// The name under which its result is kept.
    pub(crate) fn id(&self) -> ResultId {
        let (kind, id, [number, count]) = match self {
            Self::Member(workspace) => (b"m", workspace.id, [0, 0]),
            Self::Slab { of, number, count } => (b"s", of.id, [*number, *count]),
            Self::Volumes(map) => (b"v", map.id, [0, 0]),
        };
        let mut hasher = blake3::Hasher::new();
        hasher.update(LAYOUT).update(kind).update(id.job().as_bytes());
        hasher.update(&number.to_le_bytes()).update(&count.to_le_bytes());
        hasher.finalize().into()
    }

    /// Its machine.
    pub(crate) fn published(&self) -> &std::sync::Arc<Published> {
        match self {
            Self::Member(workspace) => &workspace.published,
            Self::Slab { of, .. } => &of.published,
            Self::Volumes(map) => &map.published,
        }
    }

    /// Estimated work, seconds of one core, of a whole that is estimated at `whole` and has so many pieces.
    pub(crate) fn cost(&self, whole: f64, pieces: u32) -> f64 {
        match self {
            Self::Member(_) => whole / f64::from(pieces.max(1)),
            Self::Slab { number, count, .. } => {
                let [from, to] = [*number, number + 1].map(|cut| f64::from(cut) / f64::from(*count));
                whole * (1.0 - VOLUMES_SHARE) * (share(to) - share(from))
            }
            Self::Volumes(_) => whole * VOLUMES_SHARE,
        }
    }

    /// The piece as text.
    pub(crate) fn written(&self) -> WrittenPiece {
        match self {
            Self::Member(workspace) => WrittenPiece::Member(workspace.request),
            Self::Slab { of, number, count } => {
                WrittenPiece::Slab { of: of.request, number: *number, count: *count }
            }
            Self::Volumes(map) => WrittenPiece::Volumes(map.request),
        }
    }
}

impl WrittenPiece {
    /// The piece of a machine's question.
    pub(crate) fn read(self, published: std::sync::Arc<Published>) -> Piece {
        match self {
            Self::Member(request) => Piece::Member(WorkspaceQuestion::of(published, request)),
            Self::Slab { of, number, count } => {
                Piece::Slab { of: DexterityQuestion::of(published, of), number, count }
            }
            Self::Volumes(request) => Piece::Volumes(DexterityQuestion::of(published, request)),
        }
    }
}
