//! Machines: the built-in one, similar ones, and arbitrary numbers.

use verne_solver::machine::{Geometry, Limits, Table};
use verne_solver::{Machine, MachineData};

use crate::draw::Draw;
use crate::lengths::lengths;

/// A machine, if the numbers are valid. Otherwise the error must name a field.
pub(crate) fn machine(draw: &mut Draw<'_>) -> Option<Machine> {
    if draw.one_in(4) {
        return Some(Machine::verne());
    }
    let data = data(draw);
    match Machine::new(data.clone()) {
        Ok(machine) => Some(machine),
        Err(faults) => {
            assert!(!faults.is_empty() && faults.iter().all(|fault| !fault.field.is_empty()), "{data:?}");
            None
        }
    }
}

/// Numbers near those of the built-in machine, at any scale; some are replaced by arbitrary numbers.
fn data(draw: &mut Draw<'_>) -> MachineData {
    let mut data = Machine::verne().data().clone();
    let scale = if draw.one_in(3) { draw.between(-6.0, 6.0).exp() } else { 1.0 };
    let spread = draw.pick(&[0.0, 0.1, 0.5, 1.0]);
    let wild = draw.pick(&[0, 0, 0, 1, 4]);
    let strokes = data.limits.stroke.as_flattened_mut();
    for length in all_lengths(&mut data.geometry, &mut data.table).chain(strokes) {
        *length *= scale * (1.0 + spread * draw.between(-1.0, 1.0));
    }
    for small in small(&mut data.limits) {
        *small *= 1.0 + spread * draw.between(-1.0, 1.0);
    }
    if draw.one_in(8) {
        data.limits.slider_axes = Some([0; 4].map(|_| [0; 3].map(|_| draw.number(1.0))));
    }
    if draw.one_in(8) {
        data.limits.platform_axes = Some([0; 4].map(|_| [0; 3].map(|_| draw.number(1.0))));
    }
    for _ in 0..wild {
        let number = draw.number(1000.0 * scale);
        let MachineData { geometry, table, limits, .. } = &mut data;
        let which = draw.below(29);
        let chosen = match which {
            0..15 => all_lengths(geometry, table).nth(which),
            15..21 => limits.stroke.as_flattened_mut().get_mut(which - 15),
            _ => small(limits).nth(which - 21),
        };
        *chosen.unwrap() = number;
    }
    data
}

/// All lengths but the strokes.
fn all_lengths<'a>(geometry: &'a mut Geometry, table: &'a mut Table) -> impl Iterator<Item = &'a mut f64> {
    lengths(geometry).into_iter().chain([&mut table.da, &mut table.dt])
}

fn small(limits: &mut Limits) -> impl Iterator<Item = &mut f64> {
    let Limits { slider_cone, platform_cone, serial_margin, parallel_margin, tilt, rotary, .. } = limits;
    let plain = [slider_cone, platform_cone, serial_margin, parallel_margin];
    plain.into_iter().chain(tilt).chain(rotary.iter_mut().flatten())
}
