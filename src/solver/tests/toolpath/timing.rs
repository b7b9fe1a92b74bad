//! Times of rows against what needs no oracle: the drives' limits, sums, bounds, symmetry and closed forms.

use std::collections::HashMap;

use verne_solver::Machine;
use verne_solver::machine::{Drive, Drives};
use verne_solver::toolpath::{
    Curve, Feed, Governor, Motion, Pace, PlanOptions, Row, RowKind, TimedRow, Timer, Times,
};

use super::random::Random;
use super::random_programs::{machine, program};
use super::support::{arrive, feed, planned, rapid};

pub(crate) const CYCLE: f64 = 0.004;

fn drive(velocity: f64, acceleration: Option<f64>) -> Drive {
    Drive { velocity, acceleration }
}

pub(crate) fn drives() -> Drives {
    Drives { slider: drive(500.0, Some(3000.0)), tilt: drive(0.6, Some(4.0)), rotary: drive(1.0, Some(8.0)) }
}

fn without_accelerations(drives: Drives) -> Drives {
    let sudden = |drive: Drive| Drive { acceleration: None, ..drive };
    Drives { slider: sudden(drives.slider), tilt: sudden(drives.tilt), rotary: sudden(drives.rotary) }
}

pub(crate) fn timed(
    rows: &[Row],
    drives: Option<Drives>,
    pace: impl Fn(usize) -> Pace,
) -> (Vec<TimedRow>, Times) {
    let mut timed = Vec::new();
    let mut timer = Timer::new(drives, CYCLE, pace, |row: &TimedRow| timed.push(*row));
    for row in rows {
        timer.push(row);
    }
    let times = timer.finish();
    assert_eq!(timed.len(), rows.len());
    assert!(timed.iter().zip(rows).all(|(timed, row)| timed.row == *row), "in order");
    (timed, times)
}

pub(crate) fn at(feed: Feed) -> impl Fn(usize) -> Pace {
    move |_| Pace { feed, from_rest: false }
}

fn joints(row: &Row) -> [f64; 5] {
    let [rho1, rho2, rho3] = row.rho;
    [rho1, rho2, rho3, row.table.theta1, row.table.theta2]
}

fn mean_velocities(before: &TimedRow, row: &TimedRow) -> [f64; 5] {
    let (a, b) = (joints(&before.row), joints(&row.row));
    [0, 1, 2, 3, 4].map(|i| if a[i] == b[i] { 0.0 } else { (b[i] - a[i]) / row.duration.unwrap() })
}

/// A random program on a random machine with its rows.
fn random_rows(random: &mut Random) -> (Machine, Vec<Motion>, Vec<Row>) {
    loop {
        let machine = machine(random);
        let program = program(&machine, random);
        let (_, rows) = planned(&machine, &program, &PlanOptions::default());
        if rows.iter().skip(1).all(|row| row.way.is_some())
            && rows.last().unwrap().motion + 1 == program.len()
        {
            return (machine, program, rows);
        }
    }
}

#[test]
fn rows_keep_to_the_velocities_and_accelerations() {
    let mut random = Random::new(5);
    let (mut fastest, mut hardest, mut examined): (f64, f64, u32) = (0.0, 0.0, 0);
    for _ in 0..24 {
        let (_, program, rows) = random_rows(&mut random);
        let limits = drives().of_joints();
        let feed = if random.between(0.0, 1.0) < 0.5 { Feed::Drives } else { Feed::Tip(80.0) };
        let (timed, _) = timed(&rows, Some(drives()), at(feed));
        for three in timed.windows(3) {
            let [before, row, after] = [&three[0], &three[1], &three[2]];
            if row.duration.is_none() || row.duration == Some(0.0) {
                continue;
            }
            let velocities = mean_velocities(before, row);
            for (velocity, limit) in velocities.iter().zip(&limits) {
                fastest = fastest.max(velocity.abs() / limit.velocity);
            }
            if let (Feed::Tip(speed), RowKind::Feed | RowKind::Inserted) = (feed, row.row.kind) {
                let length = row.row.way.unwrap().length;
                assert!(length <= speed * row.duration.unwrap() * (1.0 + 1e-9));
            }
            if row.row.ends_track || after.duration.unwrap() == 0.0 {
                continue;
            }
            let next = mean_velocities(row, after);
            let time = 0.5 * (row.duration.unwrap() + after.duration.unwrap());
            for i in 0..5 {
                let acceleration = (next[i] - velocities[i]).abs() / time;
                hardest = hardest.max(acceleration / limits[i].acceleration.unwrap());
            }
            examined += 1;
        }
        assert!(!program.is_empty());
    }
    println!("{examined} places, fastest {fastest}, hardest {hardest}");
    assert!(examined > 500 && fastest > 0.99 && hardest > 0.9, "{examined} {fastest} {hardest}");
    assert!(fastest <= 1.0 + 1e-6, "{fastest} of the velocity");
    assert!(hardest <= 1.0 + 1e-6, "{hardest} of the acceleration");
}

#[test]
fn durations_sum_to_the_time_and_no_drive_alone_is_slower() {
    let mut random = Random::new(6);
    for _ in 0..16 {
        let (_, _, rows) = random_rows(&mut random);
        let quick = without_accelerations(drives());
        let mut before = 0.0;
        for drives in [quick, drives()] {
            let (timed, times) = timed(&rows, Some(drives), at(Feed::Tip(150.0)));
            let sum: f64 = timed.iter().filter_map(|row| row.duration).sum();
            let governed: f64 = times.by_feed + times.by_joint.iter().sum::<f64>();
            assert!((sum / times.time - 1.0).abs() < 1e-9 && (governed / times.time - 1.0).abs() < 1e-9);
            assert_eq!(times.unknown, 0);
            for (i, drive) in drives.of_joints().iter().enumerate() {
                let way = |pair: &[Row]| match pair[1].way {
                    Some(_) => (joints(&pair[1])[i] - joints(&pair[0])[i]).abs(),
                    None => 0.0,
                };
                let way: f64 = rows.windows(2).map(way).sum();
                assert!(times.time >= way / drive.velocity * (1.0 - 1e-12));
            }
            let length: f64 = feed_lengths(&rows).values().sum();
            assert!(times.time >= length / 150.0 * (1.0 - 1e-12));
            assert!(times.time >= before, "accelerations take time");
            before = times.time;
        }
    }
}

fn feed_lengths(rows: &[Row]) -> HashMap<usize, f64> {
    let mut lengths = HashMap::new();
    for row in rows.iter().filter(|row| matches!(row.kind, RowKind::Feed | RowKind::Inserted)) {
        *lengths.entry(row.motion).or_default() += row.way.map_or(0.0, |way| way.length);
    }
    lengths
}

#[test]
fn twice_the_velocities_and_feeds_take_half_the_time() {
    let mut random = Random::new(7);
    for _ in 0..8 {
        let (_, _, rows) = random_rows(&mut random);
        let doubled = |drive: Drive| drive_with(2.0 * drive.velocity);
        let slow = without_accelerations(drives());
        let fast =
            Drives { slider: doubled(slow.slider), tilt: doubled(slow.tilt), rotary: doubled(slow.rotary) };
        let feeds = |factor: f64| {
            move |motion: usize| {
                let feed = match motion % 4 {
                    0 => Feed::Tip(60.0 * factor),
                    1 => Feed::Duration(1.5 / factor),
                    2 => Feed::Axis(0.1 * factor),
                    _ => Feed::Drives,
                };
                Pace { feed, from_rest: motion.is_multiple_of(3) }
            }
        };
        let (slow_rows, slow) = timed(&rows, Some(slow), feeds(1.0));
        let (fast_rows, fast) = timed(&rows, Some(fast), feeds(2.0));
        assert!((slow.time / fast.time - 2.0).abs() < 1e-9, "{} {}", slow.time, fast.time);
        assert!(slow_rows.iter().zip(&fast_rows).all(|(slow, fast)| slow.governor == fast.governor));
    }
}

fn drive_with(velocity: f64) -> Drive {
    drive(velocity, None)
}

#[test]
fn a_reversed_program_takes_the_same_time() {
    let mut random = Random::new(8);
    for _ in 0..8 {
        let (machine, program, _) = random_rows(&mut random);
        let reversed = reversed(&program);
        let time = |program: &[Motion]| {
            let (_, rows) = planned(&machine, program, &PlanOptions::default());
            timed(&rows, Some(drives()), at(Feed::Tip(100.0))).1.time
        };
        let (there, back) = (time(&program), time(&reversed));
        println!("{there} {back}");
        assert!((there / back - 1.0).abs() < 0.01, "{there} {back}");
    }
}

fn reversed(program: &[Motion]) -> Vec<Motion> {
    let back = |curve| match curve {
        Curve::Arc { centre, normal, sweep } => Curve::Arc { centre, normal: normal.map(|c| -c), sweep },
        Curve::Line => Curve::Line,
    };
    let first = Motion { end: program.last().unwrap().end, ..program[0] };
    let motions = program.windows(2).rev();
    let motions = motions.map(|pair| Motion { end: pair[0].end, curve: back(pair[1].curve), ..pair[1] });
    std::iter::once(first).chain(motions).collect()
}

#[test]
fn without_drives_the_feed_alone_determines_the_time() {
    let up = [0.0, 0.0, 1.0];
    let program = [
        arrive([-100.0, 0.0, 300.0], up),
        feed([0.0, 0.0, 300.0], up),
        feed([0.0, 0.0, 300.0], up),
        feed([0.0, 0.0, 300.0], [0.0, 0.2, 1.0]),
        rapid([0.0, 0.0, 350.0], [0.0, 0.2, 1.0]),
    ];
    let (_, rows) = planned(&Machine::verne(), &program, &PlanOptions::default());
    let of_motion = |timed: &[TimedRow], motion: usize| -> Option<f64> {
        timed.iter().filter(|row| row.row.motion == motion).map(|row| row.duration).sum()
    };
    let (tip, times) = timed(&rows, None, at(Feed::Tip(50.0)));
    assert_eq!(of_motion(&tip, 0), None, "the machine comes from anywhere");
    assert!((of_motion(&tip, 1).unwrap() - 2.0).abs() < 1e-9);
    assert_eq!(of_motion(&tip, 2), Some(0.0), "nothing moves");
    assert_eq!(of_motion(&tip, 3), None, "the tip does not move");
    assert_eq!(of_motion(&tip, 4), None, "rapids have no feed");
    let moved = rows.iter().filter(|row| row.motion > 2).count();
    assert_eq!(times.unknown, moved as u64);
    assert!((times.time - 2.0).abs() < 1e-9 && times.by_feed == times.time);
    let (inverse, _) = timed(&rows, None, at(Feed::Duration(3.0)));
    let durations = [1, 2, 3].map(|motion| of_motion(&inverse, motion).unwrap());
    assert!((durations[0] - 3.0).abs() < 1e-9 && (durations[2] - 3.0).abs() < 1e-9, "{durations:?}");
    assert_eq!(durations[1], 0.0, "a move without length takes no time");
    let (axis, _) = timed(&rows, None, at(Feed::Axis(0.05)));
    let angle = 0.2_f64.atan();
    assert!((of_motion(&axis, 3).unwrap() - angle / 0.05).abs() < 1e-9);
    let (_, times) = timed(&rows, Some(without_accelerations(drives())), at(Feed::Drives));
    assert_eq!(times.unknown, 0);
}

#[test]
fn a_turn_at_the_pole_is_timed_by_the_rotary_drive() {
    let program = [
        arrive([60.0, 0.0, 300.0], [0.0, -0.3, 1.0]),
        feed([60.0, 0.0, 300.0], [0.0, 0.0, 1.0]),
        feed([60.0, 0.0, 300.0], [0.3, 0.0, 1.0]),
    ];
    let options = PlanOptions { pole: 0.0, ..PlanOptions::default() };
    let (_, rows) = planned(&Machine::verne(), &program, &options);
    let quick = Drives { slider: drive_with(1e6), ..without_accelerations(drives()) };
    let (timed, _) = timed(&rows, Some(quick), at(Feed::Tip(50.0)));
    let turns: Vec<&TimedRow> = timed.iter().filter(|row| row.row.kind == RowKind::Turn).collect();
    assert!(turns.len() > 20, "{}", turns.len());
    assert!(turns.iter().all(|row| row.governor == Some(Governor::Joint(4))));
    let time: f64 = turns.iter().filter_map(|row| row.duration).sum();
    let turned: f64 = turns.iter().filter_map(|row| row.row.way).map(|way| way.angle).sum();
    assert!((time - turned).abs() < 1e-9 && turned > 1.5, "{time} {turned}: 1 rad/s");
}
