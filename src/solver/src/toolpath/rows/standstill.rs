//! Where the machine stands: before the program, and where it takes another tool.

use super::{RowKind, RowPlace, Rower};
use crate::toolpath::motion::Motion;
use crate::toolpath::path::Path;

impl Rower<'_> {
    /// The row where the machine stands before the program.
    pub(super) fn begin(&mut self, motion: &Motion) {
        if let Some(start) = self.settings.start {
            let at = start.position(self.setting.machine, motion.tool_length);
            let place = RowPlace::of_arrival(at.tip);
            self.row(0, RowKind::Rapid, &place, &start.node(), motion.tool_length);
        }
    }

    /// The path of a motion if the tool is another one: it begins at the new tool's end, because in a cap the axis is
    /// not exactly the path's. Examines the new tool's limits there.
    pub(super) fn take_tool(&mut self, index: usize, motion: &Motion, path: &Path) -> Option<Path> {
        let length = motion.tool_length;
        let is_same = self.tool_length.is_none_or(|before| before.to_bits() == length.to_bits());
        let now = self.now.filter(|_| !is_same)?;
        let (_, fraction) = self.meet(index, (&now, length));
        self.margin = Some(fraction);
        let [tip, _] = now.tool(self.setting.machine, length).position();
        Some(path.begun_at(tip.into(), motion))
    }
}
