//! Checks a request for a calibration in JSON.

use verne_solver::calibration::{Measurements, Observed, PartTip, Plan, TipDistance};
use verne_solver::{Machine, Point, TableAngles};

use crate::operations::batch_rows::MAX_EXPLAINED;
use crate::operations::calibration::{CalibrationQuestion, MOST_MEASUREMENTS, Measured};
use crate::operations::calibration_options::without_measurements;
use crate::operations::machine_registry::MachineRegistry;
use crate::wire::bounded_list::BoundedList;
use crate::wire::calibration::{CalibrationRequest, MeasurementKind, PairRow};
use crate::wire::degrees::from_degrees;
use crate::wire::error::OperationError;
use crate::wire::field_errors::FieldErrors;
use crate::wire::fixed_array::Triple;
use crate::wire::parse::parse_body;

/// Reads and checks a request in JSON. Call it on the compute pool.
///
/// # Errors
///
/// All fields that cannot be used.
pub(crate) fn read_calibration(
    body: &[u8],
    machines: &MachineRegistry,
    max_rows: usize,
) -> Result<CalibrationQuestion, OperationError> {
    let request: CalibrationRequest = parse_body(body)?;
    let counts = [
        Some(request.rho.len()),
        request.table.as_ref().map(BoundedList::len),
        request.points.as_ref().map(BoundedList::len),
        request.pairs.as_ref().map(BoundedList::len),
        request.lengths.as_ref().map(BoundedList::len),
    ];
    check_count(counts.into_iter().flatten().max().unwrap_or_default(), max_rows)?;
    let (mut question, mut faults) = without_measurements(&request, machines)?;
    check_lists(&request, &mut faults);
    check_numbers(&request, &question.machine, &mut faults);
    faults.into_first(MAX_EXPLAINED)?;
    question.measured = measured(&request);
    Ok(question)
}

/// The most measurements of one request, for a service that allows `max_rows` rows.
pub(crate) fn most(max_rows: usize) -> usize {
    MOST_MEASUREMENTS.min(max_rows)
}

/// Refuses more measurements than one request may have.
pub(crate) fn check_count(rows: usize, max_rows: usize) -> Result<(), OperationError> {
    let limit = most(max_rows);
    if rows > limit { Err(OperationError::TooManyRows { rows, limit }) } else { Ok(()) }
}

/// Refuses lists that the kind does not have, or whose lengths differ.
fn check_lists(request: &CalibrationRequest, faults: &mut FieldErrors) {
    let kind = request.kind;
    let poses = request.rho.len();
    if poses == 0 {
        faults.add("/rho", "must have at least one pose");
    }
    let [table, points, lengths] = [
        request.table.as_ref().map(BoundedList::len),
        request.points.as_ref().map(BoundedList::len),
        request.lengths.as_ref().map(BoundedList::len),
    ];
    let lists = [
        ("/table", table, kind == MeasurementKind::Part),
        ("/points", points, kind.has_points()),
        ("/lengths", lengths, kind == MeasurementKind::Ballbar),
    ];
    for (pointer, count, belongs) in lists {
        match count {
            Some(_) if !belongs => faults.add(pointer, format!("kind `{}` does not have it", kind.name())),
            Some(count) if count != poses => {
                let detail = format!("must have {poses} entries as `rho`, one for each pose, not {count}");
                faults.add(pointer, detail);
            }
            _ => {}
        }
    }
    if kind == MeasurementKind::Part && table.is_none() {
        faults.add("/table", "`table` is missing: kind `part` needs it");
    }
    match &request.pairs {
        Some(_) if kind != MeasurementKind::Distances => {
            faults.add("/pairs", format!("kind `{}` does not have it", kind.name()));
        }
        None if kind == MeasurementKind::Distances => {
            faults.add("/pairs", "`pairs` is missing: kind `distances` needs it");
        }
        Some(pairs) => check_pairs(pairs.items(), poses, faults),
        None => {}
    }
}

fn check_pairs(pairs: &[PairRow], poses: usize, faults: &mut FieldErrors) {
    if pairs.is_empty() {
        faults.add("/pairs", "must have at least one pair");
    }
    let has_values = pairs.first().is_some_and(|pair| pair.len() == 3);
    for (i, pair) in pairs.iter().enumerate() {
        let places: Vec<_> = pair.iter().take(2).filter_map(|number| index(*number, poses)).collect();
        let detail = match places.as_slice() {
            [a, b] if a == b => "must name two different poses".to_owned(),
            [_, _] if pair.len() == 3 && !has_values || pair.len() == 2 && has_values => {
                "must have a distance if the first pair has one, and none otherwise".to_owned()
            }
            [_, _] => continue,
            _ => format!("must be [i, j, distance] with poses from 0 to {}", poses.saturating_sub(1)),
        };
        faults.add(format!("/pairs/{i}"), detail);
    }
}

/// A number of JSON as the index of a pose.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number within a list")]
#[allow(clippy::cast_precision_loss, reason = "a list has at most a million entries")]
fn index(number: f64, count: usize) -> Option<usize> {
    (number >= 0.0 && number < count as f64 && number.fract() == 0.0).then_some(number as usize)
}

fn check_numbers(request: &CalibrationRequest, machine: &Machine, faults: &mut FieldErrors) {
    for (i, rho) in request.rho.items().iter().enumerate() {
        faults.point(&format!("/rho/{i}"), &rho.0, machine);
    }
    for (i, table) in request.table.iter().flat_map(BoundedList::items).enumerate() {
        for (k, angle) in table.0.into_iter().enumerate() {
            faults.angle(&format!("/table/{i}/{k}"), Some(angle));
        }
    }
    for (i, point) in request.points.iter().flat_map(BoundedList::items).enumerate() {
        check_measured_point(&format!("/points/{i}"), point, request.kind, machine, faults);
    }
    let lengths = request.lengths.iter().flat_map(BoundedList::items).enumerate();
    let lengths = lengths.map(|(i, length)| (format!("/lengths/{i}"), *length));
    let pairs = request.pairs.iter().flat_map(BoundedList::items).enumerate();
    let distances = pairs.filter_map(|(i, pair)| Some((format!("/pairs/{i}/2"), *pair.get(2)?)));
    for (pointer, length) in lengths.chain(distances) {
        check_length(&pointer, length, machine, faults);
    }
}

/// A point of a tracker may be anywhere: the tracker's frame follows it.
fn check_measured_point(
    pointer: &str,
    point: &Triple,
    kind: MeasurementKind,
    machine: &Machine,
    faults: &mut FieldErrors,
) {
    if kind == MeasurementKind::Tracker {
        faults.lengths(pointer, &point.0);
    } else {
        faults.point(pointer, &point.0, machine);
    }
}

fn check_length(pointer: &str, length: f64, machine: &Machine, faults: &mut FieldErrors) {
    if length < 0.0 {
        faults.add(pointer, "must be a length of at least 0 mm");
    } else {
        faults.length(pointer, length);
        faults.proportion(pointer, length, machine);
    }
}

/// The measurements of a checked request.
fn measured(request: &CalibrationRequest) -> Measured {
    let rho: Vec<[f64; 3]> = request.rho.items().iter().map(|rho| rho.0).collect();
    let points = request.points.as_ref();
    let points = points.map(|points| points.items().iter().map(|point| point.0).collect::<Vec<Point>>());
    let table = || {
        let table = request.table.iter().flat_map(BoundedList::items);
        table.map(|pair| table_angles(pair.0)).collect::<Vec<_>>()
    };
    let centre = request.centre.map(|centre| centre.0);
    let poses = rho.len();
    let (plan, observed) = match request.kind {
        MeasurementKind::Tips => (Plan::Tips, points.map(Observed::Tips)),
        MeasurementKind::Tracker => (Plan::TrackerTips, points.map(Observed::TrackerTips)),
        MeasurementKind::Part => {
            let tips = points.map(|tips| {
                let tips = table().into_iter().zip(tips);
                Observed::PartTips(tips.map(|(table, tip)| PartTip { table, tip }).collect())
            });
            (Plan::PartTips(table()), tips)
        }
        MeasurementKind::Ballbar => {
            let lengths = request.lengths.as_ref().map(|lengths| lengths.items().to_vec());
            (Plan::BallBar(centre), lengths.map(|lengths| Observed::BallBar { centre, lengths }))
        }
        MeasurementKind::Distances => {
            let pairs = request.pairs.iter().flat_map(BoundedList::items);
            distances(pairs, poses)
        }
    };
    match observed {
        Some(observed) => Measured::Values(Measurements { rho, observed }),
        None => Measured::Planned(rho, plan),
    }
}

fn distances<'a>(pairs: impl Iterator<Item = &'a PairRow>, poses: usize) -> (Plan, Option<Observed>) {
    let pair = |row: &PairRow| {
        let [from, to] = [0, 1].map(|i| row.get(i).and_then(|number| index(*number, poses)));
        Some(([from?, to?], row.get(2).copied()))
    };
    let pairs: Vec<_> = pairs.filter_map(pair).collect();
    let values = pairs.iter().map(|(poses, length)| Some(TipDistance { poses: *poses, length: (*length)? }));
    let values = values.collect::<Option<Vec<_>>>();
    let plan = Plan::Distances(pairs.into_iter().map(|(poses, _)| poses).collect());
    (plan, values.map(Observed::Distances))
}

/// The table's angles from degrees.
pub(crate) fn table_angles([theta1, theta2]: [f64; 2]) -> TableAngles {
    TableAngles { theta1: from_degrees(theta1), theta2: from_degrees(theta2) }
}
