//! Kernels that compute many rows at once, and the processor's registers for which they are compiled.
//!
//! A kernel consists of loops over rows whose numbers lie by coordinate. The body of a loop is the code that also
//! computes a single row, without calls and branches, so that the compiler computes two, four or eight rows with one
//! instruction. All of them are operations of IEEE 754, which no compiler changes or combines: the numbers are the
//! same to the last bit for every kind of registers. A row that needs a branch is unusual: the kernel marks it, and the
//! code for a single row answers it.

use multiversion::multiversion;

use crate::machine::Machine;

/// Number of rows that the functions of many rows compute together.
pub const BLOCK_ROWS: usize = 32;

/// Number of rows that a kernel computes together.
pub(crate) const ROWS: usize = BLOCK_ROWS;

/// A computation for [`ROWS`] rows. It is compiled into the functions below: it and all that it calls is
/// `inline(always)`.
pub(crate) trait Kernel {
    /// Computes all rows. The machine is an argument of its own, for then the compiler knows that the kernel does not
    /// write to it.
    fn run(&mut self, machine: &Machine);
}

/// The registers with which functions of many rows compute. The answers are the same to the last bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Registers {
    /// The widest ones that the processor has: on x86-64 those of AVX-512, AVX2 or SSE2.
    Widest,
    /// At most those of AVX2, of four numbers.
    Avx2,
    /// Those that every processor of the architecture has: SSE2 or NEON, of two numbers.
    Baseline,
}

impl Registers {
    /// Runs a kernel. Not inline: every caller would contain the kernel for each kind of registers.
    #[inline(never)]
    pub(crate) fn run<K: Kernel>(self, kernel: &mut K, machine: &Machine) {
        match self {
            Self::Widest => run_widest(kernel, machine),
            Self::Avx2 => run_avx2(kernel, machine),
            Self::Baseline => run_baseline(kernel, machine),
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"), dispatcher = "direct")]
fn run_widest<K: Kernel>(kernel: &mut K, machine: &Machine) {
    kernel.run(machine);
}

#[multiversion(targets("x86_64+avx2"), dispatcher = "direct")]
fn run_avx2<K: Kernel>(kernel: &mut K, machine: &Machine) {
    kernel.run(machine);
}

#[inline(never)]
fn run_baseline<K: Kernel>(kernel: &mut K, machine: &Machine) {
    kernel.run(machine);
}

/// Writes the numbers of at most [`ROWS`] rows by coordinate.
#[inline]
pub(crate) fn set_columns<const N: usize>(
    columns: &mut [[f64; ROWS]; N],
    rows: impl Iterator<Item = [f64; N]>,
) {
    for (i, row) in (0..ROWS).zip(rows) {
        for (column, number) in columns.iter_mut().zip(row) {
            column[i] = number;
        }
    }
}
