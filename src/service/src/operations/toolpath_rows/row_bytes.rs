//! One row as bytes: little-endian, in the order of the fields of [`StoredRow`].

use verne_program::{Move, Program};
use verne_solver::toolpath::{Row, RowKind, ToolPosition};
use verne_solver::{Constraint, Element, Margin, TableAngles};

/// Bytes of a row: two numbers of four bytes, six codes and two spare bytes, then thirteen doubles.
pub(crate) const ROW_BYTES: usize = 8 + 8 + 13 * 8;

/// Every kind of row. The code of a kind is its index.
const KINDS: [RowKind; 7] = [
    RowKind::Rapid,
    RowKind::Feed,
    RowKind::Inserted,
    RowKind::Turn,
    RowKind::Retract,
    RowKind::Rewind,
    RowKind::Approach,
];

/// A row as it is stored: mm, radians and seconds, in the part frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StoredRow {
    /// The line of the program.
    pub line: u32,
    /// The index of the program's move.
    pub index: u32,
    /// The purpose of the row.
    pub kind: RowKind,
    /// Where the tool is.
    pub position: ToolPosition,
    /// The sliders.
    pub rho: [f64; 3],
    /// The table.
    pub table: TableAngles,
    /// How long the motion to this row takes; nothing if neither a feed nor drives say so.
    pub duration: Option<f64>,
    /// The worst margin.
    pub margin: Margin,
}

impl StoredRow {
    /// A row of a program's plan.
    pub(crate) fn new(row: &Row, program: &Program, duration: Option<f64>) -> Self {
        let Row { motion, kind, position, rho, table, margin, .. } = *row;
        let line = program.moves().get(motion).map_or(0, Move::line);
        let index = u32::try_from(motion).unwrap_or(u32::MAX);
        Self { line, index, kind, position, rho, table, duration, margin }
    }
}

/// Appends a row.
pub(crate) fn write_row(row: &StoredRow, bytes: &mut Vec<u8>) {
    bytes.extend_from_slice(&row.line.to_le_bytes());
    bytes.extend_from_slice(&row.index.to_le_bytes());
    let [element, first, second] = element_code(row.margin.element);
    let kind = code_of(&KINDS, &row.kind);
    let constraint = code_of(&Constraint::ALL, &row.margin.constraint);
    let has_duration = u8::from(row.duration.is_some());
    bytes.extend_from_slice(&[kind, has_duration, constraint, element, first, second, 0, 0]);
    let ToolPosition { tip, axis } = row.position;
    let TableAngles { theta1, theta2 } = row.table;
    let last = [theta1, theta2, row.duration.unwrap_or_default(), row.margin.value];
    for number in tip.into_iter().chain(axis).chain(row.rho).chain(last) {
        bytes.extend_from_slice(&number.to_le_bytes());
    }
}

/// The row of some bytes; nothing if another version wrote them.
pub(crate) fn read_row(bytes: &[u8]) -> Option<StoredRow> {
    let (head, numbers) = bytes.split_first_chunk::<16>()?;
    let (numbers, rest) = numbers.as_chunks::<8>();
    let numbers: &[[u8; 8]; 13] = numbers.try_into().ok()?;
    let numbers = numbers.map(f64::from_le_bytes);
    let [l0, l1, l2, l3, i0, i1, i2, i3, kind, has_duration, constraint, element, first, second, _, _] =
        *head;
    let [x, y, z, i, j, k, rho1, rho2, rho3, theta1, theta2, duration, value] = numbers;
    rest.is_empty().then_some(())?;
    Some(StoredRow {
        line: u32::from_le_bytes([l0, l1, l2, l3]),
        index: u32::from_le_bytes([i0, i1, i2, i3]),
        kind: *KINDS.get(usize::from(kind))?,
        position: ToolPosition { tip: [x, y, z], axis: [i, j, k] },
        rho: [rho1, rho2, rho3],
        table: TableAngles { theta1, theta2 },
        duration: (has_duration == 1).then_some(duration),
        margin: Margin {
            constraint: *Constraint::ALL.get(usize::from(constraint))?,
            element: element_of([element, first, second])?,
            value,
        },
    })
}

/// The index of an item in a list that has all of them.
fn code_of<T: PartialEq>(all: &[T], item: &T) -> u8 {
    all.iter().position(|other| other == item).and_then(|code| u8::try_from(code).ok()).unwrap_or(u8::MAX)
}

fn element_code(element: Element) -> [u8; 3] {
    match element {
        Element::Stroke { slider, high } => [0, slider, u8::from(high)],
        Element::Leg(leg) => [1, leg, 0],
        Element::Rod(rod) => [2, rod, 0],
        Element::Rods(one, other) => [3, one, other],
        Element::Range { high } => [4, u8::from(high), 0],
        Element::Platform => [5, 0, 0],
        Element::Tool => [6, 0, 0],
        Element::Joint(rod) => [7, rod, 0],
    }
}

fn element_of(code: [u8; 3]) -> Option<Element> {
    Some(match code {
        [0, slider, high] => Element::Stroke { slider, high: high == 1 },
        [1, leg, _] => Element::Leg(leg),
        [2, rod, _] => Element::Rod(rod),
        [3, one, other] => Element::Rods(one, other),
        [4, high, _] => Element::Range { high: high == 1 },
        [5, _, _] => Element::Platform,
        [6, _, _] => Element::Tool,
        [7, rod, _] => Element::Joint(rod),
        _ => return None,
    })
}
