//! Postures by coordinate: the input of functions of many margins.

use crate::pose::{PlatformPose, TableAngles};
use crate::posture::Posture;
use crate::registers::ROWS;

/// Numbers of a posture: x, y, z, alpha, rho1, rho2, rho3, theta1, theta2.
const NUMBERS: usize = 9;

/// Poses and sliders of postures, and the table's angles of those in which the table takes part. The numbers lie by
/// coordinate, so that a processor reads those of several postures at once.
///
/// ```
/// use verne_solver::{KinematicsError, Machine, PostureColumns, platform_working};
///
/// let mut postures = PostureColumns::new();
/// postures.push(&platform_working(&Machine::verne(), [0.0, 0.0, 1200.0])?, None);
/// assert_eq!(postures.len(), 1);
/// # Ok::<(), KinematicsError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct PostureColumns {
    blocks: Vec<PostureBlock>,
    rows: usize,
}

/// At most [`ROWS`] postures.
#[derive(Clone, Copy, Debug)]
pub(super) struct PostureBlock {
    pub(super) numbers: [[f64; ROWS]; NUMBERS],
    /// 1 for a posture in which the table takes part.
    pub(super) has_table: [u64; ROWS],
}

impl PostureColumns {
    /// No postures.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a posture; `table` are the table's angles, rad, if the table takes part.
    #[inline]
    pub fn push(&mut self, posture: &Posture, table: Option<TableAngles>) {
        let i = self.rows % ROWS;
        if i == 0 {
            self.blocks.push(PostureBlock::new());
        }
        if let Some(block) = self.blocks.last_mut() {
            block.set(i, posture, table);
        }
        self.rows += 1;
    }

    /// Removes all postures and keeps the memory.
    pub fn clear(&mut self) {
        self.blocks.clear();
        self.rows = 0;
    }

    /// The number of postures.
    pub fn len(&self) -> usize {
        self.rows
    }

    /// Whether there is no posture.
    pub fn is_empty(&self) -> bool {
        self.rows == 0
    }

    /// The index of the first row of each block, the number of its rows, and the block.
    pub(super) fn blocks(&self) -> impl Iterator<Item = (usize, usize, &PostureBlock)> {
        let blocks = (0..).step_by(ROWS).zip(&self.blocks);
        blocks.map(|(first, block)| (first, (self.rows - first).min(ROWS), block))
    }
}

impl PostureBlock {
    pub(super) fn new() -> Self {
        Self { numbers: [[0.0; ROWS]; NUMBERS], has_table: [0; ROWS] }
    }

    #[inline]
    fn set(&mut self, i: usize, posture: &Posture, table: Option<TableAngles>) {
        let (PlatformPose { x, y, z, alpha }, [rho1, rho2, rho3]) = (posture.pose, posture.rho);
        let TableAngles { theta1, theta2 } = table.unwrap_or(TableAngles { theta1: 0.0, theta2: 0.0 });
        let numbers = [x, y, z, alpha, rho1, rho2, rho3, theta1, theta2];
        for (column, number) in self.numbers.iter_mut().zip(numbers) {
            column[i] = number;
        }
        self.has_table[i] = u64::from(table.is_some());
    }

    #[inline(always)]
    pub(super) fn pose(&self, i: usize) -> PlatformPose {
        let [x, y, z, alpha] = [0, 1, 2, 3].map(|column: usize| self.numbers[column][i]);
        PlatformPose { x, y, z, alpha }
    }

    #[inline(always)]
    pub(super) fn rho(&self, i: usize) -> [f64; 3] {
        [4, 5, 6].map(|column: usize| self.numbers[column][i])
    }

    /// The table's angles; those of a row without a table are zero.
    #[inline(always)]
    pub(super) fn angles(&self, i: usize) -> TableAngles {
        TableAngles { theta1: self.numbers[7][i], theta2: self.numbers[8][i] }
    }

    /// The table's angles if it takes part.
    pub(super) fn table(&self, i: usize) -> Option<TableAngles> {
        (self.has_table[i] == 1).then(|| self.angles(i))
    }
}
