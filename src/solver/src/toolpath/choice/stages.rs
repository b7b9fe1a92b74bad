//! The states of all places where they may change, and the way back through them.

/// The chosen state at a place where it may change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::toolpath) struct Chosen {
    pub(in crate::toolpath) h: [i32; 2],
    /// alpha of the working solution; `None` if the place has no solution.
    pub(in crate::toolpath) alpha: Option<f64>,
}

/// The chosen states: one for each arrival, rapid, and beginning and end of a bounded stretch, in order.
pub(in crate::toolpath) type Choice = Vec<Chosen>;

/// The states at the places where they may change, each with the index of the state before it.
#[derive(Default)]
pub(super) struct Stages(Vec<Vec<(Chosen, usize)>>);

impl Stages {
    pub(super) fn push(&mut self, states: Vec<(Chosen, usize)>) {
        self.0.push(states);
    }

    /// The sequence that ends with a state of the last stage.
    pub(super) fn traced(&self, last: usize) -> Choice {
        let mut index = last;
        let mut choice: Choice = Vec::with_capacity(self.0.len());
        for stage in self.0.iter().rev() {
            let Some(&(chosen, parent)) = stage.get(index) else { break };
            choice.push(chosen);
            index = parent;
        }
        choice.reverse();
        choice
    }
}
