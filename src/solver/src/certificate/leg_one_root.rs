//! A proved solution of leg I along a locus, and the proved postures that have it.

use super::angle::directions;
use super::answer::{ALPHA_MARGIN, PostureBox};
use super::enclosure::Enclosure;
use super::krawczyk::{ProvedZero, prove};
use super::leg_one_equations::LegOneEquations;
use super::locus::EnclosedLocus;
use crate::mechanism::Mechanism;
use crate::posture::{Mode, Posture, Side};

/// A solution of equations (A), with legs II and III at its pose.
#[derive(Clone, Copy, Debug)]
pub(super) struct LegOneRoot {
    /// The posture from which it was proved.
    alpha: f64,
    rho1: f64,
    zero: ProvedZero<2>,
    /// Bounds of y, z, alpha and rho1, which contain those of the posture.
    y: Enclosure,
    z: Enclosure,
    a: Enclosure,
    slider: Enclosure,
    /// Height of the platform's joints of legs II and III, and of the legs.
    ends: [Enclosure; 2],
    heights: [Enclosure; 2],
    /// Greatest change of those heights and of z where alpha changes by [`ALPHA_MARGIN`].
    margin: f64,
    /// The modes of legs II and III in which a posture has been proved.
    proved: [[bool; 2]; 2],
}

impl LegOneRoot {
    /// The solution at a posture; `None` if it cannot be proved, or if a leg's reach is not certain there.
    pub(super) fn prove(
        mechanism: &Mechanism,
        locus: &EnclosedLocus,
        equations: &LegOneEquations<'_>,
        posture: &Posture,
    ) -> Option<Self> {
        let (pose, rho1) = (&posture.pose, posture.rho[0]);
        let zero = prove(equations, [pose.alpha, pose.z - rho1])?;
        let with = |bounds: Enclosure, number: f64| bounds.hull(Enclosure::of(number));
        let a = with(zero.bounds[0], pose.alpha);
        let turn = directions(a);
        let ([y, z], [c, s]) = (locus.at(turn), turn);
        let g = &mechanism.geometry;
        let (p, q) = (c.times(g.R2) - Enclosure::of(g.r4), s.times(g.R2));
        let x2 = locus.x + (Enclosure::of(g.D2) - Enclosure::of(g.d2));
        let height = |length: f64, y: Enclosure| {
            let length = Enclosure::of(length);
            let square = (length - x2) * (length + x2) - y.square();
            square.root().filter(|_| square.low > 0.0)
        };
        let reach = g.R2 + locus.z[1].magnitude() + locus.z[2].magnitude();
        let root = Self {
            alpha: pose.alpha,
            rho1,
            zero,
            y: with(y, pose.y),
            z: with(z, pose.z),
            a,
            slider: with(z - zero.bounds[1], rho1),
            ends: [z - q, z + q],
            heights: [height(g.L2, y - p)?, height(g.L3, y + p)?],
            margin: 2.0 * ALPHA_MARGIN * reach,
            proved: [[false; 2]; 2],
        };
        let w = root.z.widened(root.margin) - root.slider;
        let alone = zero.is_alone_in(0, a.widened(ALPHA_MARGIN)) && zero.is_alone_in(1, w);
        alone.then_some(root)
    }

    /// alpha and w1.
    pub(super) fn bounds(&self) -> [Enclosure; 2] {
        self.zero.bounds
    }

    /// Whether a posture has the same pose and the same slider of leg I as the one from which the root was proved.
    pub(super) fn is_of(&self, posture: &Posture) -> bool {
        self.alpha == posture.pose.alpha && self.rho1 == posture.rho[0]
    }

    /// The box of a posture that has this root; `None` if it is not proved.
    pub(super) fn posture_box(&mut self, x: Enclosure, posture: &Posture) -> Option<PostureBox> {
        let Mode { legs: [_, second, third], .. } = posture.mode;
        let slider = |leg: usize, side: Side| {
            let rho = self.ends[leg] - self.heights[leg].times(side.sign());
            let rho = rho.hull(Enclosure::of(posture.rho[leg + 1]));
            // At most one slider position within bounds closes the leg if all are on one side of the platform.
            (self.ends[leg].widened(self.margin) - rho).excludes_zero().then_some(rho)
        };
        let rho = [self.slider, slider(0, second)?, slider(1, third)?];
        self.proved[usize::from(second == Side::Above)][usize::from(third == Side::Above)] = true;
        Some(PostureBox {
            x: x.hull(Enclosure::of(posture.pose.x)).into(),
            y: self.y.into(),
            z: self.z.into(),
            alpha: self.a.into(),
            rho: rho.map(Into::into),
        })
    }

    /// Whether a posture is proved for legs II and III on every side.
    pub(super) fn has_all_postures(&self) -> bool {
        self.proved == [[true; 2]; 2]
    }

    /// Whether both rods of leg I hang down and do not cross, for certain, and the same for legs II and III of the
    /// posture that is proved.
    pub(super) fn is_in_working_mode(&self, equations: &LegOneEquations<'_>) -> bool {
        self.proved[1][1] && equations.hang_uncrossed([self.y, self.zero.bounds[1]], self.a)
    }
}
