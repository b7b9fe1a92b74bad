//! The hash of a machine's numbers. Answers state it: equal hashes mean the same machine, whatever its name.

use verne_solver::MachineData;

/// Begins the hash. It changes when the list of numbers below changes.
const HASH_PREFIX: &[u8] = b"verne machine 1";

/// BLAKE3, in hexadecimal digits, of geometry, table and limits as little-endian doubles in a fixed order: lengths in
/// mm, angles in radians, -0 as 0. Name, description and drives are left out because they
/// change no solution.
pub(crate) fn machine_hash(data: &MachineData) -> String {
    let mut hasher = blake3::Hasher::new();
    hasher.update(HASH_PREFIX);
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
    limits.into_iter().chain(l.tilt).for_each(&mut put);
    match l.rotary {
        Some(range) => range.into_iter().for_each(&mut put),
        // No range has its limits the wrong way round.
        None => [f64::INFINITY, f64::NEG_INFINITY].into_iter().for_each(&mut put),
    }
    for axes in [l.slider_axes, l.platform_axes] {
        put(if axes.is_some() { 1.0 } else { 0.0 });
        axes.into_iter().flatten().flatten().for_each(&mut put);
    }
    // Optional numbers come last, so that they do not change the hash of machines without them.
    l.table_clearance.into_iter().for_each(&mut put);
    if g.parallelogram_direction != 0.0 {
        // No table clearance is negative.
        [-1.0, g.parallelogram_direction].into_iter().for_each(&mut put);
    }
    hasher.finalize().to_hex().to_string()
}
