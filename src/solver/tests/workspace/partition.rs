//! Portions of a workspace compared with the whole: areas and volumes sum within the claimed errors.

use verne_solver::workspace::{Kind, Measure, Request, Unobserved, Volume, measure};
use verne_solver::{Machine, MachineData};

use crate::machines::spread;
use crate::random::Random;
use crate::requests::request;

fn measured(machine: &Machine, request: &Request) -> Measure {
    measure(machine, request, &Unobserved).unwrap()
}

/// Sums of areas and volumes, and of their claimed errors. The volume is omitted if a portion folds.
#[derive(Default)]
struct Sum {
    area: [f64; 2],
    volume: [f64; 2],
    folded: bool,
}

impl Sum {
    fn of(parts: impl IntoIterator<Item = Measure>) -> Self {
        let mut sum = Self::default();
        for part in parts {
            sum.area = [sum.area[0] + part.area, sum.area[1] + part.area_error];
            match part.volume {
                Volume::Value { value, error } => {
                    sum.volume = [sum.volume[0] + value, sum.volume[1] + error];
                }
                Volume::Folded => sum.folded = true,
            }
        }
        sum
    }

    fn volume_is(&self, whole: &Self) -> bool {
        let off = (self.volume[0] - whole.volume[0]).abs();
        self.folded || whole.folded || off <= self.volume[1] + whole.volume[1]
    }

    fn is(&self, whole: &Self) -> bool {
        let off = (self.area[0] - whole.area[0]).abs();
        off <= self.area[1] + whole.area[1] && self.volume_is(whole)
    }
}

fn changed(machine: &Machine, change: impl FnOnce(&mut MachineData)) -> Machine {
    let mut data = machine.data().clone();
    change(&mut data);
    Machine::new(data).unwrap()
}

/// Machines with a workspace, and how it is measured as a whole.
fn machines(seed: u64, count: usize) -> impl Iterator<Item = (Machine, Measure)> {
    let mut numbers = Random::new(seed);
    std::iter::repeat_with(move || spread(&mut numbers))
        .flatten()
        .map(|machine| {
            let machine = changed(&machine, |data| data.limits.tilt = [-10.0, 10.0]);
            let whole = measured(&machine, &request(Kind::Part, 50.0, 0.0, 1.0));
            (machine, whole)
        })
        .filter(|(_, whole)| whole.area > whole.area_error)
        .take(count)
}

/// In the working mode |alpha| is below a right angle.
#[test]
fn bands_of_the_tilting_range_sum_to_the_whole() {
    let mut numbers = Random::new(0x1d87_2b41);
    for (number, (machine, whole)) in machines(0x9d5c_fb4a_0b73_11e9, 120).enumerate() {
        let most = whole.inclination.unwrap();
        let mut cuts: Vec<f64> = (0..3 + number % 8).map(|_| numbers.between(-most, most)).collect();
        cuts.extend([-1.6, 1.6]);
        cuts.sort_by(f64::total_cmp);
        let question = request(Kind::Part, 50.0, 0.0, 1.0);
        let parts = Sum::of(cuts.windows(2).filter(|band| band[0] < band[1]).map(|band| {
            measured(&changed(&machine, |data| data.limits.tilt = [band[0], band[1]]), &question)
        }));
        assert!(parts.is(&Sum::of([whole])), "{:?} {:?} {whole:?} {cuts:?}", parts.area, machine.data());
    }
}

/// A tilting range of `width` and tools inclined by its multiples: adjacent bands of alpha. Most of them are empty.
#[test]
fn bands_of_phi1_sum_to_the_whole() {
    let mut numbers = Random::new(0x77aa_0913);
    for (machine, whole) in machines(0x2c1b_3c6d_5511_aa07, 60) {
        let width = whole.inclination.unwrap() * numbers.between(0.3, 0.9);
        let start = numbers.between(-width, 0.0);
        let narrow = changed(&machine, |data| data.limits.tilt = [start, start + width]);
        let bands = (1.7 / width).ceil() as i32;
        let question =
            |band: i32| Request { phi1: f64::from(band) * width, ..request(Kind::Part, 50.0, 0.0, 1.0) };
        let parts = Sum::of((-bands..=bands).map(|band| measured(&narrow, &question(band))));
        assert!(parts.is(&Sum::of([whole])), "{:?} {:?} {whole:?}", parts.area, machine.data());
    }
}

/// One slider's stroke in bands: each column is divided, and the volumes of its portions sum.
#[test]
fn bands_of_a_stroke_sum_to_the_whole() {
    let mut numbers = Random::new(0x4432_9907);
    let question = request(Kind::Platform, 0.0, 0.0, 1.0);
    for (number, (machine, _)) in machines(0x51ed_270b_a3c4_0f15, 100).enumerate() {
        let whole = Sum::of([measured(&machine, &question)]);
        let slider = number % 3;
        let [low, high] = machine.data().limits.stroke[slider];
        let mut cuts: Vec<f64> = (0..3).map(|_| numbers.between(low, high)).collect();
        cuts.extend([low, high]);
        cuts.sort_by(f64::total_cmp);
        let parts = Sum::of(cuts.windows(2).map(|band| {
            measured(&changed(&machine, |data| data.limits.stroke[slider] = [band[0], band[1]]), &question)
        }));
        assert!(parts.volume_is(&whole), "{:?} {:?} {:?}", parts.volume, whole.volume, machine.data());
    }
}
