//! Measurements in columns: CSV, NDJSON and Arrow.

use std::collections::HashMap;

use verne_rows::{Chunk, Column, Format, Numbers, Reader};
use verne_solver::calibration::{Measurements, Observed, PartTip, Plan, TipDistance};
use verne_solver::{Machine, TableAngles};

use crate::operations::batch_rows::MAX_EXPLAINED;
use crate::operations::calibration::{CalibrationQuestion, Measured, Places};
use crate::operations::calibration_options::without_measurements;
use crate::operations::calibration_request::{check_count, most, table_angles};
use crate::operations::column_rows::{Group, pointer, row_names};
use crate::operations::machine_registry::MachineRegistry;
use crate::operations::row_stream::read_error;
use crate::wire::calibration::{CalibrationRequest, MeasurementKind};
use crate::wire::error::{FieldError, OperationError};
use crate::wire::field_errors::{is_angle, is_length, out_of_proportion};

/// The column to which a fault of a whole row points.
const FIRST: &str = "rho1";

/// The columns of a kind. Every row has the first ones, whose number is the second value. The others are those of the
/// measured value; they may all be missing.
fn columns(kind: MeasurementKind) -> (Group, usize) {
    match kind {
        MeasurementKind::Tips | MeasurementKind::Tracker => (&["rho1", "rho2", "rho3", "x", "y", "z"], 3),
        MeasurementKind::Part => (&["rho1", "rho2", "rho3", "theta1", "theta2", "x", "y", "z"], 5),
        MeasurementKind::Ballbar => (&["rho1", "rho2", "rho3", "length"], 3),
        MeasurementKind::Distances => {
            (&["rho1", "rho2", "rho3", "to_rho1", "to_rho2", "to_rho3", "distance"], 6)
        }
    }
}

/// A request without its measurements, which come in columns.
pub(crate) struct CalibrationTable {
    question: CalibrationQuestion,
    kind: MeasurementKind,
    centre: Option<[f64; 3]>,
}

impl CalibrationTable {
    /// Checks everything but the measurements.
    ///
    /// # Errors
    ///
    /// All fields that cannot be used.
    pub(crate) fn new(
        request: &CalibrationRequest,
        machines: &MachineRegistry,
    ) -> Result<Self, OperationError> {
        let (question, faults) = without_measurements(request, machines)?;
        faults.into_result()?;
        Ok(Self { question, kind: request.kind, centre: request.centre.map(|centre| centre.0) })
    }

    /// Reads and checks the measurements. Call it on the compute pool.
    ///
    /// # Errors
    ///
    /// The columns and rows that cannot be used.
    pub(crate) fn read(
        self,
        format: Format,
        body: &[u8],
        max_rows: usize,
    ) -> Result<CalibrationQuestion, OperationError> {
        let Self { mut question, kind, centre } = self;
        let mut rows = Rows::new(kind, &question.machine);
        let mut reader = Reader::new(format, columns(kind).0, body.len());
        reader.push(body);
        reader.end();
        let mut count = 0;
        while let Some(chunk) = reader.next_chunk().map_err(read_error)? {
            count += chunk.rows();
            if count <= most(max_rows) {
                rows.add(&chunk)?;
            }
        }
        check_count(count, max_rows)?;
        if rows.count == 0 {
            rows.begin(&reader.columns().unwrap_or_default())?;
            return Err(OperationError::Rows("there is no row".to_owned()));
        }
        (question.measured, question.places) = rows.finish(centre)?;
        Ok(question)
    }
}

/// The rows that were read.
struct Rows<'a> {
    kind: MeasurementKind,
    machine: &'a Machine,
    /// The columns of a row in their order; empty before they are known.
    names: Vec<&'static str>,
    count: usize,
    rho: Vec<[f64; 3]>,
    /// The row of each pose, as messages name it.
    places: Vec<String>,
    table: Vec<TableAngles>,
    points: Vec<[f64; 3]>,
    lengths: Vec<f64>,
    pairs: Vec<[usize; 2]>,
    /// The poses of distances by the bits of their numbers: rows share poses.
    known: HashMap<[u64; 3], usize>,
    faults: Vec<FieldError>,
}

impl<'a> Rows<'a> {
    fn new(kind: MeasurementKind, machine: &'a Machine) -> Self {
        Self {
            kind,
            machine,
            names: Vec::new(),
            count: 0,
            rho: Vec::new(),
            places: Vec::new(),
            table: Vec::new(),
            points: Vec::new(),
            lengths: Vec::new(),
            pairs: Vec::new(),
            known: HashMap::new(),
            faults: Vec::new(),
        }
    }

    /// Checks which columns there are.
    fn begin(&mut self, present: &[Column]) -> Result<(), OperationError> {
        let (all, required) = columns(self.kind);
        let (required, measured) = all.split_at(required);
        self.names = row_names(present, required, &[measured], false)?;
        Ok(())
    }

    fn add(&mut self, chunk: &Chunk) -> Result<(), OperationError> {
        if self.names.is_empty() {
            self.begin(chunk.columns())?;
        }
        let numbers = self.names.iter().map(|name| chunk.column(name).and_then(Column::as_numbers));
        let numbers: Vec<_> = numbers.collect::<Option<_>>().ok_or(OperationError::Internal)?;
        let mut faults = chunk.faults().iter().peekable();
        for row in 0..chunk.rows() {
            let place = match chunk.line(row) {
                Some(line) => format!("row {} in line {line}", self.count),
                None => format!("row {}", self.count),
            };
            self.count += 1;
            match faults.next_if(|fault| fault.row == row) {
                Some(fault) => self.fault(FIRST, &place, &fault.detail),
                None => self.add_row(&numbers, row, place),
            }
        }
        Ok(())
    }

    fn add_row(&mut self, columns: &[Numbers<'_>], row: usize, place: String) {
        let mut numbers = Vec::with_capacity(columns.len());
        for (i, column) in columns.iter().enumerate() {
            let name = self.names[i];
            match self.checked(name, column.get(row)) {
                Ok(number) => numbers.push(number),
                Err(detail) => self.fault(name, &place, &format!("{name} {detail}")),
            }
        }
        if numbers.len() < columns.len() {
            return;
        }
        let triple = |from: usize| [numbers[from], numbers[from + 1], numbers[from + 2]];
        let rest = columns.len() - columns_before(self.kind);
        match self.kind {
            MeasurementKind::Distances => self.add_pair([triple(0), triple(3)], &place),
            _ => self.add_pose(triple(0), place),
        }
        if self.kind == MeasurementKind::Part {
            self.table.push(table_angles([numbers[3], numbers[4]]));
        }
        match rest {
            0 => {}
            1 => self.lengths.push(numbers[columns.len() - 1]),
            _ => self.points.push(triple(columns.len() - 3)),
        }
    }

    /// A number of a row, or why it cannot be used.
    fn checked(&self, name: &str, number: Option<f64>) -> Result<f64, String> {
        let number = number.filter(|number| !number.is_nan()).ok_or("is not a number")?;
        let is_point = matches!(name, "x" | "y" | "z");
        if name.starts_with("theta") {
            return if is_angle(number) { Ok(number) } else { Err("is too large an angle".to_owned()) };
        }
        if matches!(name, "length" | "distance") && number < 0.0 {
            return Err("must be at least 0 mm".to_owned());
        }
        if !is_length(number) {
            return Err("must be a length within ±1e7 mm".to_owned());
        }
        let is_anywhere = is_point && self.kind == MeasurementKind::Tracker;
        match out_of_proportion(number, self.machine).filter(|_| !is_anywhere) {
            Some(detail) => Err(detail),
            None => Ok(number),
        }
    }

    fn fault(&mut self, name: &str, place: &str, detail: &str) {
        if self.faults.len() < MAX_EXPLAINED {
            self.faults.push(FieldError::new(pointer(name), format!("{place}: {detail}")));
        }
    }

    fn add_pose(&mut self, rho: [f64; 3], place: String) {
        self.rho.push(rho);
        self.places.push(place);
    }

    fn add_pair(&mut self, poses: [[f64; 3]; 2], place: &str) {
        let pair = poses.map(|rho| {
            let next = self.rho.len();
            let pose = *self.known.entry(rho.map(|number| (number + 0.0).to_bits())).or_insert(next);
            if pose == next {
                self.add_pose(rho, place.to_owned());
            }
            pose
        });
        if pair[0] == pair[1] {
            self.fault("to_rho1", place, "must be another pose than rho1, rho2, rho3");
        }
        self.pairs.push(pair);
    }

    /// The measurements, and where the poses stand.
    fn finish(self, centre: Option<[f64; 3]>) -> Result<(Measured, Places), OperationError> {
        if !self.faults.is_empty() {
            return Err(OperationError::Fields(self.faults));
        }
        let has_values = self.names.len() > columns_before(self.kind);
        let distance = |(poses, length): (&[usize; 2], &f64)| TipDistance { poses: *poses, length: *length };
        let tip = |(table, tip): (&TableAngles, &[f64; 3])| PartTip { table: *table, tip: *tip };
        let observed = match self.kind {
            MeasurementKind::Tips => Observed::Tips(self.points),
            MeasurementKind::Tracker => Observed::TrackerTips(self.points),
            MeasurementKind::Part => {
                Observed::PartTips(self.table.iter().zip(&self.points).map(tip).collect())
            }
            MeasurementKind::Ballbar => Observed::BallBar { centre, lengths: self.lengths },
            MeasurementKind::Distances => {
                Observed::Distances(self.pairs.iter().zip(&self.lengths).map(distance).collect())
            }
        };
        let plan = match self.kind {
            MeasurementKind::Tips => Plan::Tips,
            MeasurementKind::Tracker => Plan::TrackerTips,
            MeasurementKind::Part => Plan::PartTips(self.table),
            MeasurementKind::Ballbar => Plan::BallBar(centre),
            MeasurementKind::Distances => Plan::Distances(self.pairs),
        };
        let measured = if has_values {
            Measured::Values(Measurements { rho: self.rho, observed })
        } else {
            Measured::Planned(self.rho, plan)
        };
        Ok((measured, Places::Rows(self.places)))
    }
}

/// The number of columns before those of the measured value.
fn columns_before(kind: MeasurementKind) -> usize {
    columns(kind).1
}
