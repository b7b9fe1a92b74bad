//! The free slots of a worker, and the order of those that wait for one.

use parking_lot::Mutex;
use tokio::sync::Notify;

use crate::counts::Slots;
use crate::execution::slot::{Slot, SlotKind};
use crate::jetstream::queue_class::QueueClass;

pub(super) struct SlotPool {
    state: Mutex<State>,
    /// Notified when a slot becomes free, or fewer wait for one.
    changed: Notify,
    total: usize,
}

pub(super) struct State {
    free: Vec<Slot>,
    /// Jobs that wait for a slot and go before all queued ones.
    waiting_for_main: usize,
    waiting_for_any: usize,
    /// Reasons not to start queued jobs.
    pauses: usize,
}

/// Which job needs a slot.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Priority {
    /// A job in a queue at the broker.
    Queued,
    /// A merge, or a job that the worker has already received.
    First,
}

impl SlotPool {
    pub(super) fn new(free: Vec<Slot>) -> Self {
        let total = free.len();
        let state = State { free, waiting_for_main: 0, waiting_for_any: 0, pauses: 0 };
        Self { state: Mutex::new(state), changed: Notify::new(), total }
    }

    pub(super) fn counts(&self) -> Slots {
        Slots { total: self.total, busy: self.total.saturating_sub(self.state.lock().free.len()) }
    }

    /// Waits until a queued job could have a slot.
    pub(super) async fn wait_for_slot(&self, class: QueueClass) {
        loop {
            let changed = self.changed.notified();
            if self.state.lock().position(class, Priority::Queued).is_some() {
                return;
            }
            changed.await;
        }
    }

    /// Takes a slot for a queued job.
    pub(super) fn take(&self, class: QueueClass) -> Option<Slot> {
        self.state.lock().take(class, Priority::Queued)
    }

    /// Takes the guest slot for a queued job.
    pub(super) fn take_guest(&self) -> Option<Slot> {
        let mut state = self.state.lock();
        let position = state.free.iter().position(|slot| slot.kind == SlotKind::Guest)?;
        (state.pauses == 0).then(|| state.free.swap_remove(position))
    }

    /// Waits for a slot, before all queued jobs.
    pub(super) async fn take_first(&self, class: QueueClass) -> Slot {
        let _waiting = Waiting::new(self, move |state| match class {
            QueueClass::Small => &mut state.waiting_for_any,
            QueueClass::Subtask | QueueClass::Large => &mut state.waiting_for_main,
        });
        loop {
            let changed = self.changed.notified();
            if let Some(slot) = self.state.lock().take(class, Priority::First) {
                return slot;
            }
            changed.await;
        }
    }

    /// No queued job gets a slot until the guard is dropped.
    pub(super) fn pause(&self) -> Waiting<'_, impl Fn(&mut State) -> &mut usize> {
        Waiting::new(self, |state| &mut state.pauses)
    }

    pub(super) fn give_back(&self, slot: Slot) {
        self.state.lock().free.push(slot);
        self.changed.notify_waiters();
    }
}

impl State {
    fn take(&mut self, class: QueueClass, priority: Priority) -> Option<Slot> {
        let position = self.position(class, priority)?;
        Some(self.free.swap_remove(position))
    }

    /// Small jobs use a main slot, or else the express slot; all others use a main slot. A job that waits for a main
    /// slot does not keep small jobs from the express slot.
    fn position(&self, class: QueueClass, priority: Priority) -> Option<usize> {
        let is_queued = priority == Priority::Queued;
        if is_queued && self.pauses > 0 {
            return None;
        }
        let free = |kind| self.free.iter().position(|slot| slot.kind == kind);
        let main = || {
            free(SlotKind::Main).filter(|_| !is_queued || self.waiting_for_main + self.waiting_for_any == 0)
        };
        let express = || free(SlotKind::Express).filter(|_| !is_queued || self.waiting_for_any == 0);
        match class {
            QueueClass::Subtask | QueueClass::Large => main(),
            QueueClass::Small => main().or_else(express),
        }
    }
}

/// Counts one more in a counter of the pool until it is dropped.
pub(super) struct Waiting<'a, F: Fn(&mut State) -> &mut usize> {
    pool: &'a SlotPool,
    counter: F,
}

impl<'a, F: Fn(&mut State) -> &mut usize> Waiting<'a, F> {
    fn new(pool: &'a SlotPool, counter: F) -> Self {
        *counter(&mut pool.state.lock()) += 1;
        Self { pool, counter }
    }
}

impl<F: Fn(&mut State) -> &mut usize> Drop for Waiting<'_, F> {
    fn drop(&mut self) {
        *(self.counter)(&mut self.pool.state.lock()) -= 1;
        self.pool.changed.notify_waiters();
    }
}
