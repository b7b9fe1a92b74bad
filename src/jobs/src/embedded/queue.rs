//! Which job is next: self-clocked fair queueing in two bands, small and other.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::time::{Duration, Instant};

use crate::JobId;
use crate::threads::pools::Lane;

/// A queued job.
#[derive(Clone, Debug)]
pub(super) struct Waiting {
    pub(super) id: JobId,
    /// To whom it is charged.
    pub(super) client: String,
    /// Seconds of one core.
    pub(super) cost: f64,
    pub(super) bytes: usize,
    /// It is for the express lane as well.
    pub(super) is_small: bool,
    pub(super) since: Instant,
}

/// The virtual time at which a job's share is used up, seconds of one core.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tag(f64);

impl Tag {
    /// Before all others.
    const FIRST: Self = Self(f64::NEG_INFINITY);

    /// Where a share of `cost` that begins here ends.
    pub(super) fn plus(self, cost: f64) -> Self {
        Self(self.0 + cost)
    }
}

impl PartialEq for Tag {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Tag {}

impl PartialOrd for Tag {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Tag {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

/// A job that has left the queue for its turn.
#[derive(Clone, Debug)]
pub(super) struct Taken {
    pub(super) life: u64,
    pub(super) job: Waiting,
    pub(super) tag: Tag,
}

impl Taken {
    /// Where its share begins.
    pub(super) fn start(&self) -> Tag {
        self.tag.plus(-self.job.cost)
    }
}

/// Tag and life: the earlier submission first where tags are equal.
type Place = (Tag, u64);

#[derive(Default)]
struct Band {
    by_tag: BTreeSet<Place>,
    /// By life, which is by age.
    by_age: BTreeMap<u64, (Waiting, Tag)>,
}

/// The queue's order. A job is named by its life, a number that grows with every submission.
pub(super) struct Queue {
    small: Band,
    other: Band,
    /// What each client has queued; its last is the client's last tag.
    clients: HashMap<String, BTreeSet<Place>>,
    /// Virtual time.
    now: Tag,
    bytes: usize,
    cost: f64,
    /// A job that has waited longer goes before all that have not.
    overdue: Duration,
}

impl Queue {
    pub(super) fn new(overdue: Duration) -> Self {
        let (small, other) = (Band::default(), Band::default());
        Self { small, other, clients: HashMap::new(), now: Tag(0.0), bytes: 0, cost: 0.0, overdue }
    }

    pub(super) fn len(&self) -> usize {
        self.small.by_age.len() + self.other.by_age.len()
    }

    /// Of all payloads.
    pub(super) fn bytes(&self) -> usize {
        self.bytes
    }

    /// Of all jobs, seconds of one core.
    pub(super) fn cost(&self) -> f64 {
        self.cost
    }

    /// `after`: where its share begins, if that is settled; otherwise it is behind what its client has queued.
    pub(super) fn push(&mut self, life: u64, job: Waiting, after: Option<Tag>) {
        let tag = self.tag(&job.client, job.cost, after);
        self.bytes += job.bytes;
        self.cost += job.cost;
        self.insert(life, job, tag);
    }

    /// It had its turn before, and is the next.
    pub(super) fn push_first(&mut self, life: u64, job: Waiting) {
        self.push(life, job, Some(Tag::FIRST));
    }

    /// `client` asks for a queued job as well: it moves to where its own submission would stand, if that is earlier, and
    /// is then charged to it. It is small if it is for one of them.
    pub(super) fn join(&mut self, life: u64, client: &str, is_small: bool, after: Option<Tag>) {
        let Some((job, tag)) = self.extract(life) else {
            return;
        };
        let is_small = is_small || job.is_small;
        let own = self.tag(client, job.cost, after);
        if own < tag {
            self.insert(life, Waiting { client: client.to_owned(), is_small, ..job }, own);
        } else {
            self.insert(life, Waiting { is_small, ..job }, tag);
        }
    }

    pub(super) fn remove(&mut self, life: u64) -> Option<Waiting> {
        let (job, _) = self.extract(life)?;
        self.forget(&job);
        Some(job)
    }

    /// The next job for `lane`, at `now`.
    pub(super) fn take(&mut self, lane: Lane, now: Instant) -> Option<Taken> {
        let life = self.overdue(lane, now).or_else(|| self.least(lane).map(|(_, life)| life))?;
        self.taken(life)
    }

    /// The next job for the main lane of another client than this one, at `now`.
    pub(super) fn take_other(&mut self, client: &str, now: Instant) -> Option<Taken> {
        let overdue = self.overdue(Lane::Main, now);
        let is_other = |life: &u64| {
            let mut bands = self.bands(Lane::Main).filter_map(|band| band.by_age.get(life));
            bands.any(|(job, _)| job.client != client)
        };
        let others = self.clients.iter().filter(|(other, _)| *other != client);
        let least = others.filter_map(|(_, places)| places.first()).min().map(|(_, life)| *life);
        self.taken(overdue.filter(is_other).or(least)?)
    }

    fn taken(&mut self, life: u64) -> Option<Taken> {
        let (job, tag) = self.extract(life)?;
        self.forget(&job);
        Some(Taken { life, job, tag })
    }

    /// A job that was taken uses its share whole, not by its parts.
    pub(super) fn reached(&mut self, tag: Tag) {
        // What has passed others, small or overdue, must not set back those who come after them.
        let reached = self.least(Lane::Main).map_or(tag, |(waiting, _)| waiting.min(tag));
        self.now = self.now.max(reached);
    }

    fn bands(&self, lane: Lane) -> impl Iterator<Item = &Band> {
        std::iter::once(&self.small).chain((lane == Lane::Main).then_some(&self.other))
    }

    fn overdue(&self, lane: Lane, now: Instant) -> Option<u64> {
        let oldest =
            self.bands(lane).filter_map(|band| band.by_age.first_key_value()).min_by_key(|(life, _)| **life);
        let (life, (job, _)) = oldest?;
        (now.saturating_duration_since(job.since) > self.overdue).then_some(*life)
    }

    fn least(&self, lane: Lane) -> Option<Place> {
        self.bands(lane).filter_map(|band| band.by_tag.first()).min().copied()
    }

    fn tag(&self, client: &str, cost: f64, after: Option<Tag>) -> Tag {
        let last = || self.clients.get(client).and_then(BTreeSet::last).map_or(self.now, |(tag, _)| *tag);
        after.unwrap_or_else(|| self.now.max(last())).plus(cost)
    }

    fn insert(&mut self, life: u64, job: Waiting, tag: Tag) {
        self.clients.entry(job.client.clone()).or_default().insert((tag, life));
        let band = if job.is_small { &mut self.small } else { &mut self.other };
        band.by_tag.insert((tag, life));
        band.by_age.insert(life, (job, tag));
    }

    fn extract(&mut self, life: u64) -> Option<(Waiting, Tag)> {
        let band = if self.small.by_age.contains_key(&life) { &mut self.small } else { &mut self.other };
        let (job, tag) = band.by_age.remove(&life)?;
        band.by_tag.remove(&(tag, life));
        if let Some(places) = self.clients.get_mut(&job.client) {
            places.remove(&(tag, life));
            if places.is_empty() {
                self.clients.remove(&job.client);
            }
        }
        Some((job, tag))
    }

    fn forget(&mut self, job: &Waiting) {
        self.bytes -= job.bytes;
        self.cost -= job.cost;
    }
}
