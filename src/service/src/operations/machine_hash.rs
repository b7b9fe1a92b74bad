//! The hash by which two answers can be compared: of a machine's numbers, whatever it is called.

use verne_solver::MachineData;

/// Changes when the list of numbers below does.
const LAYOUT: &[u8] = b"verne machine 1";

/// BLAKE3, in hex, of geometry, table and limits as little-endian doubles in a fixed order. Name and
/// description stay out: they change no answer. Lengths in mm and angles in radians, -0 as 0.
pub(crate) fn machine_hash(data: &MachineData) -> String {
    let mut hasher = blake3::Hasher::new();
    hasher.update(LAYOUT);
    let mut put = |number: f64| {
        hasher.update(&(number + 0.0).to_le_bytes());
    };
    let g = &data.geometry;
    let dimensions = [
        g.D1,
        g.d1,
        g.D2,
        g.d2,
        g.R1,
        g.r1,
        g.R2,
        g.r4,
        g.L1,
        g.L2,
        g.L3,
        g.parallelogram_half_width,
        g.rod_radius,
    ];
    dimensions.into_iter().for_each(&mut put);
    [data.table.da, data.table.dt].into_iter().for_each(&mut put);
    let l = &data.limits;
    l.stroke.into_iter().flatten().for_each(&mut put);
    let limits = [l.slider_cone, l.platform_cone, l.serial_margin, l.parallel_margin];
    limits.into_iter().chain(l.tilt).chain(l.rotary).for_each(&mut put);
    for axes in [l.slider_axes, l.platform_axes] {
        put(if axes.is_some() { 1.0 } else { 0.0 });
        axes.into_iter().flatten().flatten().for_each(&mut put);
    }
    // Machines without it keep the hash that they had before there was such a limit.
    l.table_clearance.into_iter().for_each(&mut put);
    hasher.finalize().to_hex().to_string()
}
