//! The parallel module's dimensions, and the constants of the formulas that follow from them.

/// Dimensions of the parallel module, in mm, with the paper's symbols (Fig. 3, Eqs (3)-(6)).
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(non_snake_case, reason = "the paper's symbols: D1 and d1 are two dimensions")]
pub struct Geometry {
    /// x of leg I's joints on the platform, in the platform frame.
    pub D1: f64,
    /// x of leg I's guideway, in the base frame.
    pub d1: f64,
    /// x of legs II and III's joints on the platform, in the platform frame.
    pub D2: f64,
    /// x of legs II and III's guideways, in the base frame.
    pub d2: f64,
    /// Half-distance of leg I's joints on the platform.
    pub R1: f64,
    /// Half-distance of leg I's joints on the slider.
    pub r1: f64,
    /// Half-distance of legs II and III on the platform.
    pub R2: f64,
    /// Half-distance of legs II and III's guideways.
    pub r4: f64,
    /// Rod length of leg I.
    pub L1: f64,
    /// Rod length of leg II.
    pub L2: f64,
    /// Rod length of leg III.
    pub L3: f64,
    /// Half-width w of the parallelograms of legs II and III.
    pub parallelogram_half_width: f64,
    /// Angle g of their width from x towards y, rad: leg II has g, leg III has -g. It is zero unless R1 = r1. It
    /// matters for rod interference only.
    pub parallelogram_direction: f64,
    /// Radius of every rod.
    pub rod_radius: f64,
}

/// Fraction of L1² below which the square of leg I's height is computed with twice the digits.
const NEARLY_LEVEL: f64 = 1e-6;

/// R1/r1 - 1, and |e1 - e2| relative to the longest leg, below which the forward problem is solved without elimination.
/// The elimination was seen to lose solutions below 5e-4.
pub(crate) const FAMILY_EDGE: f64 = 1e-2;

/// The parallel module: its dimensions, and constants of the formulas that are derived once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Mechanism {
    pub(crate) geometry: Geometry,
    /// e1 = D1 - d1 and e2 = D2 - d2.
    pub(crate) e1: f64,
    pub(crate) e2: f64,
    /// C = R1² + r1² and k = 2 R1 r1, so that u² + v² = C - k cos a.
    pub(crate) c: f64,
    pub(crate) k: f64,
    /// (R1 - r1)².
    pub(crate) gap_square: f64,
    /// Threshold of the square of leg I's height, mm². Below it the height is computed with twice the digits.
    pub(crate) nearly_level: f64,
    /// 1/L of rod 11, rod 12, leg II, leg III.
    pub(crate) inverse_lengths: [f64; 4],
    /// 1/R1².
    pub(crate) inverse_r1_square: f64,
    /// acos(r1/R1): the rods of leg I do not cross for |alpha| up to it. Zero for R1 = r1, where they are parallel as
    /// long as the platform does not turn.
    pub(crate) uncrossed: f64,
    /// Added to the margin of crossed rods where a positive number stands for no limit: R1 if R1 = r1, else zero.
    pub(crate) crossing_reserve: f64,
    /// Whether R1 = r1 or e1 = e2, or nearly so: the elimination of the forward problem loses solutions.
    pub(crate) at_family_edge: bool,
    /// Whether e1 = e2, or nearly so.
    pub(crate) offsets_nearly_equal: bool,
    /// cos g and sin g of the direction of leg II's parallelogram, and w (cos g, sin g).
    pub(crate) pair_direction: [f64; 2],
    pub(crate) pair_offset: [f64; 2],
    /// The longest dimension that occurs in the equations: the scale of tolerances.
    pub(crate) longest: f64,
}

impl Mechanism {
    pub(crate) fn new(g: Geometry) -> Self {
        let (e1, e2) = (g.D1 - g.d1, g.D2 - g.d2);
        let offsets_nearly_equal = (e1 - e2).abs() < FAMILY_EDGE * g.L1.max(g.L2).max(g.L3);
        let (sine, cosine) = g.parallelogram_direction.sin_cos();
        let lengths = [g.L1, g.L2, g.L3, g.R1, g.r1, g.R2, g.r4, e1.abs(), e2.abs()];
        Self {
            geometry: g,
            e1,
            e2,
            c: g.R1 * g.R1 + g.r1 * g.r1,
            k: 2.0 * g.R1 * g.r1,
            gap_square: (g.R1 - g.r1) * (g.R1 - g.r1),
            nearly_level: NEARLY_LEVEL * g.L1 * g.L1,
            inverse_lengths: [1.0 / g.L1, 1.0 / g.L1, 1.0 / g.L2, 1.0 / g.L3],
            inverse_r1_square: 1.0 / (g.R1 * g.R1),
            uncrossed: 2.0 * (0.5 * (g.R1 - g.r1) / g.R1).sqrt().asin(),
            crossing_reserve: if g.R1 == g.r1 { g.R1 } else { 0.0 },
            at_family_edge: g.R1 - g.r1 < FAMILY_EDGE * g.R1 || offsets_nearly_equal,
            offsets_nearly_equal,
            pair_direction: [cosine, sine],
            pair_offset: [cosine, sine].map(|component| g.parallelogram_half_width * component),
            longest: lengths.into_iter().fold(0.0, f64::max),
        }
    }

    /// Whether R1 = r1, so that leg I is a parallelogram, too.
    pub(crate) fn is_delta(&self) -> bool {
        self.gap_square == 0.0
    }

    /// Whether the rods of leg I cross at an angle within (-π, π].
    #[inline(always)]
    pub(crate) fn crosses(&self, alpha: f64) -> bool {
        alpha.abs() > self.uncrossed
    }
}
