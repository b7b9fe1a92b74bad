//! Who has a worker's seats, and who is next.

use parking_lot::Mutex;
use tokio::sync::Notify;

use crate::jetstream::bus::Line;
use crate::threads::pools::{Lane, Seat};

pub(super) struct Seats {
    state: Mutex<State>,
    /// Notified when a seat is free, or wanted less.
    freed: Notify,
    all: usize,
}

pub(super) struct State {
    free: Vec<Seat>,
    /// Who waits for a seat before all that is queued, for one of the main lane and for any.
    first: [usize; 2],
    /// Who lets other workers go first.
    aside: usize,
}

/// One that waits for a seat.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Who {
    /// For what is queued.
    Queued,
    /// For a merge, or a job in hand.
    First,
}

impl Seats {
    pub(super) fn new(free: Vec<Seat>) -> Self {
        let all = free.len();
        Self { state: Mutex::new(State { free, first: [0, 0], aside: 0 }), freed: Notify::new(), all }
    }

    /// Those of the express and the guest lane among them.
    pub(super) fn all(&self) -> usize {
        self.all
    }

    pub(super) fn busy(&self) -> usize {
        self.all.saturating_sub(self.state.lock().free.len())
    }

    /// Returns when a queued job of a line could have a seat.
    pub(super) async fn free_for(&self, line: Line) {
        loop {
            let freed = self.freed.notified();
            if self.state.lock().place(line, Who::Queued).is_some() {
                return;
            }
            freed.await;
        }
    }

    /// For a queued job.
    pub(super) fn take(&self, line: Line) -> Option<Seat> {
        self.state.lock().take(line, Who::Queued)
    }

    /// The guest lane's, for a queued job.
    pub(super) fn take_guest(&self) -> Option<Seat> {
        let mut state = self.state.lock();
        let place = state.free.iter().position(|seat| seat.lane == Lane::Guest)?;
        (state.aside == 0).then(|| state.free.swap_remove(place))
    }

    /// A seat before all that is queued.
    pub(super) async fn first(&self, line: Line) -> Seat {
        let _first = Waiting::new(self, move |state, by| {
            let count = &mut state.first[usize::from(line == Line::Small)];
            *count = count.saturating_add_signed(by);
        });
        loop {
            let freed = self.freed.notified();
            if let Some(seat) = self.state.lock().take(line, Who::First) {
                return seat;
            }
            freed.await;
        }
    }

    /// Nothing that is queued has a seat while the guard lives.
    pub(super) fn stand_aside(&self) -> Waiting<'_, impl Fn(&mut State, isize)> {
        Waiting::new(self, |state, by| state.aside = state.aside.saturating_add_signed(by))
    }

    pub(super) fn give(&self, seat: Seat) {
        self.state.lock().free.push(seat);
        self.freed.notify_waiters();
    }
}

impl State {
    fn take(&mut self, line: Line, who: Who) -> Option<Seat> {
        let place = self.place(line, who)?;
        Some(self.free.swap_remove(place))
    }

    /// Small jobs take any seat, the main lane's before the other; all else the main lane's. Who waits for the main lane is
    /// not in the way of small jobs in the other.
    fn place(&self, line: Line, who: Who) -> Option<usize> {
        let [main, any] = if who == Who::First { [0, 0] } else { self.first };
        if who == Who::Queued && self.aside > 0 {
            return None;
        }
        let seat = |lane| self.free.iter().position(|seat| seat.lane == lane);
        let main = seat(Lane::Main).filter(|_| main + any == 0);
        match line {
            Line::Parts | Line::Large => main,
            Line::Small => main.or_else(|| seat(Lane::Express).filter(|_| any == 0)),
        }
    }
}

/// Counts as one that waits as long as it lives.
pub(super) struct Waiting<'a, F: Fn(&mut State, isize)> {
    seats: &'a Seats,
    count: F,
}

impl<'a, F: Fn(&mut State, isize)> Waiting<'a, F> {
    fn new(seats: &'a Seats, count: F) -> Self {
        count(&mut seats.state.lock(), 1);
        Self { seats, count }
    }
}

impl<F: Fn(&mut State, isize)> Drop for Waiting<'_, F> {
    fn drop(&mut self) {
        (self.count)(&mut self.seats.state.lock(), -1);
        self.seats.freed.notify_waiters();
    }
}
