//! Machines: the built-in one, similar ones, and arbitrary numbers.

use verne_solver::machine::{Geometry, Limits, Table};
use verne_solver::{Machine, MachineData};

use crate::draw::Draw;

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
    for length in
        lengths(&mut data.geometry, &mut data.table).into_iter().chain(data.limits.stroke.as_flattened_mut())
    {
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
        match draw.below(29) {
            which @ 0..15 => *lengths(&mut data.geometry, &mut data.table)[which] = number,
            which @ 15..21 => data.limits.stroke.as_flattened_mut()[which - 15] = number,
            which => *small(&mut data.limits)[which - 21] = number,
        }
    }
    data
}

fn lengths<'a>(geometry: &'a mut Geometry, table: &'a mut Table) -> [&'a mut f64; 15] {
    let g = geometry;
    [
        &mut g.D1,
        &mut g.d1,
        &mut g.D2,
        &mut g.d2,
        &mut g.R1,
        &mut g.r1,
        &mut g.R2,
        &mut g.r4,
        &mut g.L1,
        &mut g.L2,
        &mut g.L3,
        &mut g.parallelogram_half_width,
        &mut g.rod_radius,
        &mut table.da,
        &mut table.dt,
    ]
}

fn small(limits: &mut Limits) -> [&mut f64; 8] {
    let Limits { slider_cone, platform_cone, serial_margin, parallel_margin, tilt, rotary, .. } = limits;
    let ([low, high], [least, greatest]) = (tilt, rotary);
    [slider_cone, platform_cone, serial_margin, parallel_margin, low, high, least, greatest]
}

/// The largest dimension in the equations, for bounds of rounding errors.
pub(crate) fn scale(machine: &Machine) -> f64 {
    let g = &machine.data().geometry;
    [g.L1, g.L2, g.L3, g.R1, g.r1, g.R2, g.r4, (g.D1 - g.d1).abs(), (g.D2 - g.d2).abs()]
        .into_iter()
        .fold(0.0, f64::max)
}
