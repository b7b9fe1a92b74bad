//! Workspaces that earlier versions computed as much too small, or as not empty although they are.

use verne_solver::Machine;
use verne_solver::workspace::{Kind, Request, Unobserved, Volume, agree, contains, measure, surface};

use crate::column_lattice;
use crate::machines::{changed, spread};
use crate::random::Random;
use crate::requests::request;

fn volume(volume: Volume) -> [f64; 2] {
    match volume {
        Volume::Value { value, error } => [value, error],
        Volume::Folded => panic!("folded"),
    }
}

/// The jump of the table's angle from one end of its turn to the other is no boundary.
#[test]
fn a_tool_beyond_the_tilting_range_reaches_nothing() {
    let narrow = changed(|data| data.limits.tilt = [-20_f64, -5.0].map(f64::to_radians));
    for (machine, phi1) in [(Machine::verne(), 170.0), (Machine::verne(), -146.0), (narrow, 180.0)] {
        let question = request(Kind::Part, 50.0, phi1, 20.0);
        let answer = measure(&machine, &question, &Unobserved).unwrap();
        assert_eq!(volume(answer.volume), [0.0; 2]);
        assert_eq!([answer.area, answer.area_error], [0.0; 2]);
        assert!(surface(&machine, &question, &Unobserved).unwrap().triangles.is_empty());
    }
}

/// A tilting range of more than half a turn allows the platform two ranges of alpha, on both sides of those that it
/// excludes. Together with the excluded ones they are the whole.
#[test]
fn a_tilting_range_of_more_than_half_a_turn_allows_two_ranges_of_alpha() {
    let question = request(Kind::Part, 50.0, 180.0, 1.0);
    let area = |range: [f64; 2]| {
        let machine = changed(|data| data.limits.tilt = range.map(f64::to_radians));
        let answer = measure(&machine, &question, &Unobserved).unwrap();
        [answer.area, answer.area_error]
    };
    let parts = [area([-170.0, 165.0]), area([165.0, 190.0]), area([-1_000.0, 1_000.0])];
    assert!(parts[0][0] > 0.2 * parts[2][0] && parts[1][0] > 0.2 * parts[2][0], "{parts:?}");
    let claimed: f64 = parts.iter().map(|[_, error]| error).sum();
    assert!((parts[0][0] + parts[1][0] - parts[2][0]).abs() <= claimed, "{parts:?}");
}

/// Rod interference separates a strip from the rest, 8 % of the whole. The truth is by Monte Carlo.
#[test]
fn a_strip_that_rod_interference_separates_is_found() {
    let machine = changed(|data| {
        let g = &mut data.geometry;
        [g.D1, g.d1, g.D2, g.d2] =
            [630.419_324_785_328_2, -698.609_859_427_829, -279.018_180_220_986_9, 757.376_402_682_699_3];
        [g.R1, g.r1, g.R2, g.r4] =
            [78.567_513_672_969_37, 10.840_018_471_863_308, 191.826_852_213_272_22, 36.162_139_779_299_636];
        [g.L1, g.L2, g.L3] = [3_046.407_148_287_425_6, 1_599.880_763_279_454_4, 1_754.763_848_322_270_6];
        [g.parallelogram_half_width, g.rod_radius] = [104.588_971_422_932_33, 7.622_342_318_291_078_6];
        [data.table.da, data.table.dt] = [4_525.535_240_662_331, -3.744_496_618_692_054];
        let l = &mut data.limits;
        l.stroke = [
            [103.100_743_715_468_41, 475.522_122_872_919_6],
            [109.283_861_149_953_22, 1_172.858_169_578_111_3],
            [271.123_719_989_038_36, 1_386.186_354_751_155_2],
        ];
        (l.slider_cone, l.platform_cone) = (180_f64.to_radians(), 180_f64.to_radians());
        (l.serial_margin, l.parallel_margin) = (0.1, 0.01);
        l.tilt = [50_f64, 60.0].map(f64::to_radians);
    });
    let question = request(Kind::Part, 0.0, 0.0, 0.5);
    let answer = measure(&machine, &question, &Unobserved).unwrap();
    assert!((answer.area - 2_647.9).abs() < 5.0, "{answer:?}");
    assert!((volume(answer.volume)[0] - 1.1476e6).abs() < 3e3, "{answer:?}");
    let mesh = surface(&machine, &question, &Unobserved).unwrap();
    agree(&answer, &mesh, question.tolerance, &Unobserved).unwrap();
    assert!((mesh.volume() / 1.1476e6 - 1.0).abs() < 0.02, "{}", mesh.volume());
    let point = [1_247.569_013_718_023_4, 3_521.868_874_630_632_5, 728.843_081_307_716_4];
    assert!(contains(&machine, &question, &[point], &Unobserved).unwrap()[0].inside);
    let [low, high] = mesh.bounds().unwrap();
    let within = |axis: usize| low[axis] - 0.5 <= point[axis] && point[axis] <= high[axis] + 0.5;
    assert!((0..3).all(within), "{low:?} {high:?}");
}

/// An island of 2 mm².
#[test]
fn a_workspace_of_two_square_millimetres_is_measured() {
    let machine = changed(|data| data.limits.serial_margin = 0.835_024_823_061_727_1);
    let question = request(Kind::Platform, 0.0, 0.0, 0.1);
    let answer = measure(&machine, &question, &Unobserved).unwrap();
    let around = [[-43.0, -2.0], [-39.0, 2.0]];
    let [area, brute] = column_lattice::area_and_volume(&machine, around, 500);
    assert!((answer.area - area).abs() < 0.01 * area && answer.area_error < 1e-3 * area, "{answer:?}");
    assert!((volume(answer.volume)[0] - brute).abs() < 0.01 * brute, "{answer:?} {brute}");
    let mesh = surface(&machine, &question, &Unobserved).unwrap();
    assert!((mesh.volume() - brute).abs() < 0.2 * brute, "{}", mesh.volume());
    // Nowhere as thick as this.
    let coarse = Request { tolerance: 20.0, ..question };
    assert!(surface(&machine, &coarse, &Unobserved).unwrap().triangles.is_empty());
}

/// Legs of 148, 5 and 41 m.
#[test]
fn a_machine_with_legs_of_very_unlike_lengths_is_measured() {
    let machine = changed(|data| {
        let g = &mut data.geometry;
        [g.D1, g.d1, g.D2, g.d2] = [
            4_405.163_619_735_138,
            1.815_965_545_358_103_6,
            -832.952_685_828_242_9,
            -2.959_978_220_878_302_3,
        ];
        [g.R1, g.r1, g.R2, g.r4] =
            [1_357.885_977_001_395, 85.109_024_361_090_52, 38.773_930_173_601_16, 4_296.786_355_783_489];
        [g.L1, g.L2, g.L3] = [148_242.595_288_246_67, 4_866.364_868_820_341, 40_882.964_361_806_684];
        [g.parallelogram_half_width, g.rod_radius] = [1_935.070_807_692_835, 9.256_425_832_679_373];
        data.limits.stroke =
            [[0.0, 797_393.847_681_793_2], [0.0, 679_819.262_381_870_3], [0.0, 872_241.997_499_468_6]];
    });
    let question = request(Kind::Platform, 0.0, 0.0, 40.0);
    let answer = measure(&machine, &question, &Unobserved).unwrap();
    let mesh = surface(&machine, &question, &Unobserved).unwrap();
    let [value, error] = volume(answer.volume);
    assert!((mesh.volume() / value - 1.0).abs() < 0.01, "{} {value} ± {error}", mesh.volume());
    let [low, high] = mesh.bounds().unwrap();
    let around = [[low[0] - 99.0, low[1] - 99.0], [high[0] + 99.0, high[1] + 99.0]];
    let [area, brute] = column_lattice::area_and_volume(&machine, around, 500);
    assert!((answer.area / area - 1.0).abs() < 2e-3 && (value / brute - 1.0).abs() < 2e-3, "{area} {brute}");
}

/// Columns over all that the legs reach, for machines of any kind: integration and mesh lose no component.
#[test]
fn measure_and_surface_of_random_machines_agree_with_columns() {
    let mut numbers = Random::new(0x6a09_e667_f3bc_c909);
    let mut count = 0;
    while count < 25 {
        let Some(machine) = spread(&mut numbers) else { continue };
        let g = &machine.data().geometry;
        let (e1, e2, second) = (g.D1 - g.d1, g.D2 - g.d2, g.L2.min(g.L3));
        let half = g.L1.min(0.5 * (g.L2 + g.L3));
        let reach = [[(-e1 - g.L1).max(-e2 - second), -half], [(g.L1 - e1).min(second - e2), half]];
        let [area, brute] = column_lattice::area_and_volume(&machine, reach, 400);
        let question = request(Kind::Platform, 0.0, 0.0, 5.0);
        let answer = measure(&machine, &question, &Unobserved).unwrap();
        let [value, error] = volume(answer.volume);
        let cell = (reach[1][0] - reach[0][0]) * (reach[1][1] - reach[0][1]) / (400.0 * 400.0);
        // The lattice is off by about the root of the number of its cells on the boundary.
        let room = 4.0 * (area * cell).sqrt() * (cell / area.max(cell)).powf(0.25) + 4.0 * cell;
        assert!(
            (answer.area - area).abs() <= room + answer.area_error,
            "{answer:?} {area} {room} {machine:?}"
        );
        let height = if area > 0.0 { brute / area } else { 0.0 };
        let room = 2.0 * room * height + 4.0 * cell * height;
        assert!(
            area == 0.0 || (value - brute).abs() <= room + error,
            "{answer:?} {brute} {room} {machine:?}"
        );
        let mesh = surface(&machine, &question, &Unobserved).unwrap();
        agree(&answer, &mesh, question.tolerance, &Unobserved).unwrap();
        count += usize::from(area > 0.0);
    }
}
