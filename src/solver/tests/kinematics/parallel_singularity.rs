//! Parallel singularities in the forward problem: two assembly modes merge. One is found by
//! following a posture to where the determinant of the rods' rates changes sign; across the fold
//! the modes are two on one side and none on the other.

use nalgebra::{Vector3, Vector4};
use verne_solver::{Machine, Posture, forward};

use crate::lengths::scale;
use crate::oracle::constructed_postures::{hung, leaning};
use crate::oracle::{Found, Legs, wrapped};
use crate::random::Random;
use crate::reference_cases;

/// Distances from the fold in the space of the sliders, on a machine of a metre, mm.
const DISTANCES: [f64; 10] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12];
/// Down to here the two modes are well apart in double precision: some 1e-2 mm.
const APART: f64 = 1e-7;

/// A posture at which two assembly modes merge.
struct Fold {
    q: Vector4<f64>,
    rho: [f64; 3],
    /// Unit direction of the sliders in which the two modes come apart.
    towards_two: Vector3<f64>,
    /// Half the distance of the two modes is this times the root of the distance from the fold.
    opening: f64,
}

/// Follows a random family of postures, alpha from one value to another with y fixed, to a
/// singular one.
fn fold(machine: &Machine, draw: &mut Random) -> Option<Fold> {
    let legs = Legs::of(machine);
    let unit = scale(machine);
    let (y, side) = (unit * draw.between(-0.6, 0.6), draw.pick(&[1.0, -1.0]));
    let sides = [draw.pick(&[1.0, -1.0]), draw.pick(&[1.0, -1.0])];
    let at = |alpha: f64| hung(&legs, leaning(&legs, alpha, y, 1.2 * unit, side)?, sides);
    let det = |found: &Found| legs.rates(&found.q, &found.rho).determinant();
    let (mut low, mut high) = (draw.between(0.1, 3.0), draw.between(0.1, 3.0));
    let mirror = draw.pick(&[1.0, -1.0]);
    let sign = det(&at(mirror * low)?).signum();
    if det(&at(mirror * high)?).signum() == sign {
        return None;
    }
    for _ in 0..80 {
        let middle = f64::midpoint(low, high);
        if det(&at(mirror * middle)?).signum() == sign { low = middle } else { high = middle }
    }
    crossing(&legs, &at(mirror * low)?)
}

/// How the modes part at a singular posture; `None` where two things happen at once.
fn crossing(legs: &Legs, found: &Found) -> Option<Fold> {
    let unit = legs.scale();
    let rates = legs.rates(&found.q, &found.rho);
    let svd = rates.svd(true, true);
    if svd.singular_values[3] > 1e-12 || svd.singular_values[2] < 1e-3 {
        return None;
    }
    let pushed = svd.u?.column(3).into_owned();
    let moved = svd.v_t?.row(3).transpose();
    let sliding = legs.slider_rates(&found.q, &found.rho);
    let push: Vector3<f64> = (0..4).map(|i| sliding[i] * pushed[i]).sum();
    // The second derivative of the rods' lengths along the free motion.
    let step = 1e-4 * unit;
    let shift = Vector4::new(moved[0], moved[1], moved[2], moved[3] / legs.g.R1) * step;
    let [plus, minus] = [found.q + shift, found.q - shift].map(|q| legs.errors(&q, &found.rho));
    let bend = pushed.dot(&(plus + minus - 2.0 * legs.errors(&found.q, &found.rho))) / (step * step);
    if push.norm() < 0.1 || (bend * unit).abs() < 0.1 {
        return None;
    }
    Some(Fold {
        q: found.q,
        rho: found.rho,
        towards_two: -push.normalize() * bend.signum(),
        opening: (2.0 * push.norm() / bend.abs()).sqrt(),
    })
}

fn folds(machine: &Machine, draw: &mut Random, wanted: usize) -> Vec<Fold> {
    let found: Vec<Fold> = (0..50_000).filter_map(|_| fold(machine, draw)).take(wanted).collect();
    assert_eq!(found.len(), wanted);
    found
}

impl Fold {
    fn sliders(&self, distance: f64) -> [f64; 3] {
        [0, 1, 2].map(|i| self.rho[i] + distance * self.towards_two[i])
    }

    /// The modes within reach of the fold, and all others.
    fn split(&self, machine: &Machine, distance: f64) -> (Vec<Posture>, usize) {
        let unit = scale(machine);
        let within = 4.0 * self.opening * distance.abs().sqrt() + 1e-6 * unit;
        let near = |posture: &Posture| {
            let p = &posture.pose;
            let lever = machine.data().geometry.R1 * wrapped(p.alpha - self.q[3]);
            let off = [p.x - self.q[0], p.y - self.q[1], p.z - self.q[2], lever];
            off.into_iter().all(|d| d.abs() < within)
        };
        let modes = forward(machine, self.sliders(distance)).unwrap_or_default();
        let (near, far): (Vec<Posture>, Vec<Posture>) = modes.into_iter().partition(near);
        (near, far.len())
    }

    /// Two modes on one side, none on the other, and what double precision cannot tell is said to
    /// be merged.
    fn check(&self, machine: &Machine) {
        let unit = scale(machine) / 1000.0;
        let mut others = Vec::new();
        for relative in DISTANCES.into_iter().flat_map(|d| [d, -d]).chain([0.0]) {
            let (near, far) = self.split(machine, relative * unit);
            others.push(far);
            let what = format!(
                "{relative:e} from the fold {:?} at rho {:?}: {near:#?}\n{:?}",
                self.q,
                self.sliders(relative * unit),
                machine.data().geometry
            );
            assert!(near.iter().all(|posture| posture.residual < 1e-9 * unit), "{what}");
            let merged = near.iter().filter(|posture| posture.merged).count();
            let (one, pair, none) = (near.len() == 1 && merged == 1, near.len() == 2, near.is_empty());
            match relative {
                r if r >= APART => assert!(pair && merged == 0, "{what}"),
                r if r <= -APART => assert!(none, "{what}"),
                r if r > 0.0 => assert!(one || pair, "{what}"),
                r if r < 0.0 => assert!(none || one || pair && merged == 2, "{what}"),
                _ => assert!(one || pair, "{what}"),
            }
        }
        assert!(
            others.iter().all(|&far| far == others[0]),
            "{:?} {:?} other modes: {others:?}",
            self.q,
            self.rho
        );
    }
}

#[test]
fn two_modes_merge_at_singularities_of_the_reference_machine() {
    let (machine, mut draw) = (Machine::verne(), Random::new(91));
    for fold in folds(&machine, &mut draw, 60) {
        fold.check(&machine);
    }
}

#[test]
fn two_modes_merge_at_singularities_of_the_asymmetric_machine() {
    let (machine, mut draw) = (reference_cases::asymmetric(), Random::new(92));
    for fold in folds(&machine, &mut draw, 60) {
        fold.check(&machine);
    }
}

#[test]
fn two_modes_merge_at_singularities_of_random_machines() {
    let mut draw = Random::new(93);
    for _ in 0..60 {
        let machine = draw.machine();
        let found = (0..300).find_map(|_| fold(&machine, &mut draw));
        if let Some(fold) = found {
            fold.check(&machine);
        }
    }
}
