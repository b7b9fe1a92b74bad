//! Workspaces of several components, with holes, and of components that touch.

use verne_solver::Machine;
use verne_solver::workspace::{Kind, Surface, Unobserved, Volume, measure, slice, surface};

use crate::column_lattice;
use crate::machines::changed;
use crate::random::Random;
use crate::requests::request;
use crate::topology::Topology;

/// The reference machine with other legs: D1, d1, D2, d2, R1, r1, R2, r4, L1, L2 = L3, half width, rod radius.
fn crossing(numbers: [f64; 12]) -> Machine {
    changed(|data| legs(data, numbers))
}

fn legs(data: &mut verne_solver::MachineData, numbers: [f64; 12]) {
    let g = &mut data.geometry;
    [g.D1, g.d1, g.D2, g.d2, g.R1, g.r1, g.R2, g.r4, g.L1, g.L2, g.parallelogram_half_width, g.rod_radius] =
        numbers;
    g.L3 = g.L2;
    data.limits.slider_cone = 1.2;
    data.limits.platform_cone = 1.2;
    data.limits.serial_margin = 0.02;
    data.limits.parallel_margin = 0.0;
}

/// Its components touch along an edge at a tolerance of 4 mm.
const TOUCHING: [f64; 12] = [
    -285.199_277_999_443_5,
    369.156_926_620_714_05,
    284.264_149_523_241_1,
    -453.307_331_572_952_9,
    312.589_394_840_632_45,
    91.697_520_938_198_07,
    194.929_747_660_946_62,
    140.243_412_302_395_9,
    1_270.042_712_010_014_4,
    1_016.515_461_757_341_9,
    95.891_280_949_706_63,
    25.046_985_214_994_7,
];
const SEVEN: [f64; 12] = [
    -44.162_546_781_24,
    636.029_617_32,
    269.941_385_332_019_7,
    -441.283_423_375_879,
    320.512_314_056_498_44,
    39.383_135_482_288_89,
    184.519_525_834_920_07,
    264.683_036_084_173_3,
    979.146_528_716_093_1,
    855.344_640_555_436_1,
    88.724_605_201_655_92,
    15.282_342_488_202_131,
];
fn made(machine: &Machine, tolerance: f64) -> (Surface, Topology) {
    let mesh = surface(machine, &request(Kind::Platform, 0.0, 0.0, tolerance), &Unobserved).unwrap();
    let topology = Topology::of(&mesh);
    assert!(topology.is_manifold(), "{topology:?}");
    (mesh, topology)
}

/// A rectangle that contains a mesh of a few millimetres' tolerance and its workspace.
fn around(mesh: &Surface) -> [[f64; 2]; 2] {
    let [low, high] = mesh.bounds().unwrap();
    [[low[0] - 9.0, low[1] - 9.0], [high[0] + 9.0, high[1] + 9.0]]
}

/// The error of a lattice of columns is about the area of its cut cells: these components have long boundaries.
fn columns_agree(machine: &Machine, mesh: &Surface, tolerance: f64) {
    let [area, brute] = column_lattice::area_and_volume(machine, around(mesh), 500);
    let off = (mesh.volume() - brute).abs();
    assert!(mesh.volume() > 0.0 && off < tolerance * 4.0 * area, "{} against {brute}", mesh.volume());
}

#[test]
fn surfaces_of_several_components_are_closed_and_enclose_the_volume() {
    for (legs, tolerance, least) in [(TOUCHING, 4.0, 5), (TOUCHING, 1.0, 5), (SEVEN, 4.0, 2), (SEVEN, 1.0, 2)]
    {
        let machine = crossing(legs);
        let (mesh, topology) = made(&machine, tolerance);
        assert!(topology.components >= least, "{topology:?}");
        assert_eq!(topology.euler, 2 * i64::try_from(topology.components).unwrap(), "{topology:?}");
        columns_agree(&machine, &mesh, tolerance);
    }
}

/// Components narrower than the distance between the first lines are measured as well.
#[test]
fn the_measure_includes_narrow_components() {
    for legs in [TOUCHING, SEVEN] {
        let machine = crossing(legs);
        let measure = measure(&machine, &request(Kind::Platform, 0.0, 0.0, 1.0), &Unobserved).unwrap();
        let [area, volume] = column_lattice::area_and_volume(&machine, around(&made(&machine, 4.0).0), 900);
        let Volume::Value { value, .. } = measure.volume else { panic!("a platform's map cannot fold") };
        assert!((measure.area / area - 1.0).abs() < 4e-3, "{measure:?} against {area}");
        assert!((value / volume - 1.0).abs() < 4e-3, "{measure:?} against {volume}");
    }
}

/// The mesh may bridge strips between components that are narrower than the tolerance. The remainder of the strips are
/// holes.
#[test]
fn holes_of_the_workspace_are_holes_of_surface_and_slice() {
    let machine = crossing([
        -136.144_872_302_972_52,
        397.326_595_616_152_25,
        87.567_064_811_087_68,
        -491.300_752_602_345_14,
        171.910_684_183_442_04,
        133.270_883_552_980_25,
        356.535_988_620_696_57,
        208.766_300_168_123_4,
        1_158.657_181_917_979_8,
        883.892_217_886_751_8,
        104.602_174_174_086_73,
        5.049_414_436_683_126,
    ]);
    let (_, topology) = made(&machine, 40.0);
    assert!(topology.euler < 2 * i64::try_from(topology.components).unwrap(), "{topology:?}");
    let height = 655.858_844_089_571_2;
    let cut = [40.0, 20.0, 10.0, 5.0]
        .map(|tolerance| {
            let question = request(Kind::Platform, 0.0, 0.0, tolerance);
            slice(&machine, &question, height, &[], &Unobserved).unwrap()
        })
        .into_iter()
        .rfind(|cut| cut.polygons.iter().any(|polygon| !polygon.holes.is_empty()))
        .unwrap();
    let (n, size) = (600_i32, 4.0);
    let cells = (-n / 2..n / 2).flat_map(|i| (-n / 2..n / 2).map(move |j| [f64::from(i), f64::from(j)]));
    let cut_through = |[i, j]: &[f64; 2]| {
        column_lattice::column(&machine, (i + 0.37) * size, (j + 0.61) * size)
            .is_some_and(|[low, high]| (low..=high).contains(&height))
    };
    let area = size * size * cells.filter(cut_through).count() as f64;
    assert!((cut.area() - area).abs() < 0.05 * area, "{} against {area}", cut.area());
}

/// Legs of every kind, including those that cross: every surface that is returned is a manifold.
#[test]
fn surfaces_of_random_machines_are_manifolds() {
    let mut numbers = Random::new(7_046_029_254_386_353_131);
    let (mut several, mut count) = (0, 0);
    for _ in 0..220 {
        let ranges = [
            [-300.0, 200.0],
            [300.0, 700.0],
            [-200.0, 300.0],
            [-700.0, -300.0],
            [100.0, 400.0],
            [30.0, 180.0],
            [50.0, 450.0],
            [100.0, 600.0],
            [800.0, 1_300.0],
            [800.0, 1_300.0],
            [50.0, 110.0],
            [2.0, 32.0],
        ];
        let lengths = ranges.map(|[low, high]| numbers.between(low, high));
        let mut data = Machine::verne().data().clone();
        legs(&mut data, lengths);
        let Ok(machine) = Machine::new(data) else { continue };
        for (kind, length) in [(Kind::Platform, 0.0), (Kind::Part, 60.0)] {
            let mesh = surface(&machine, &request(kind, length, 0.0, 20.0), &Unobserved).unwrap();
            let topology = Topology::of(&mesh);
            assert!(topology.is_manifold(), "{lengths:?} {kind:?} {topology:?}");
            several += usize::from(topology.components > 1);
            count += usize::from(topology.components > 0);
        }
    }
    assert!(count > 200 && several > 20, "{count} {several}");
}
