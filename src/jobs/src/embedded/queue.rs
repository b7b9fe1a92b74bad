//! The order of queued jobs: self-clocked fair queueing in two bands, small jobs and others.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::time::{Duration, Instant};

use crate::execution::slot::SlotKind;
use crate::job_id::JobId;

/// A job in the queue.
#[derive(Clone, Debug)]
pub(super) struct QueuedJob {
    pub(super) id: JobId,
    /// The client for which it counts.
    pub(super) client: String,
    /// Seconds of one core.
    pub(super) cost: f64,
    /// Length of the payload.
    pub(super) bytes: usize,
    /// The express slot may run it.
    pub(super) is_small: bool,
    pub(super) since: Instant,
}

/// The virtual time at which a job's share is used up, seconds of one core.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tag(f64);

impl Tag {
    /// Before all others.
    const FIRST: Self = Self(f64::NEG_INFINITY);

    /// End of a share of `cost` that begins here.
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

/// A job that has left the queue to run.
#[derive(Clone, Debug)]
pub(super) struct DequeuedJob {
    pub(super) generation: u64,
    pub(super) job: QueuedJob,
    pub(super) tag: Tag,
}

impl DequeuedJob {
    /// Start of its share.
    pub(super) fn start(&self) -> Tag {
        self.tag.plus(-self.job.cost)
    }
}

/// Tag and generation: of equal tags the earlier submission is first.
type Position = (Tag, u64);

#[derive(Default)]
struct Band {
    by_tag: BTreeSet<Position>,
    /// By generation, which is the order of submission.
    by_age: BTreeMap<u64, (QueuedJob, Tag)>,
}

/// The queue. Generations name its jobs; they grow with every submission.
pub(super) struct Queue {
    small: Band,
    other: Band,
    /// Positions of each client's jobs; the last one is the client's last tag.
    clients: HashMap<String, BTreeSet<Position>>,
    virtual_time: Tag,
    bytes: usize,
    cost: f64,
    overdue_after: Duration,
}

impl Queue {
    pub(super) fn new(overdue_after: Duration) -> Self {
        let (small, other) = (Band::default(), Band::default());
        let (clients, virtual_time) = (HashMap::new(), Tag(0.0));
        Self { small, other, clients, virtual_time, bytes: 0, cost: 0.0, overdue_after }
    }

    pub(super) fn len(&self) -> usize {
        self.small.by_age.len() + self.other.by_age.len()
    }

    /// Sum of all payloads.
    pub(super) fn bytes(&self) -> usize {
        self.bytes
    }

    /// Sum of all jobs, seconds of one core.
    pub(super) fn cost(&self) -> f64 {
        self.cost
    }

    /// Adds a job. Its share begins at `start`; without it, after what its client has in the queue.
    pub(super) fn push(&mut self, generation: u64, job: QueuedJob, start: Option<Tag>) {
        let tag = self.tag(&job.client, job.cost, start);
        self.bytes += job.bytes;
        self.cost += job.cost;
        self.insert(generation, job, tag);
    }

    /// Adds a job that has left the queue before. It is the next to leave.
    pub(super) fn push_front(&mut self, generation: u64, job: QueuedJob) {
        self.push(generation, job, Some(Tag::FIRST));
    }

    /// Another client submits a queued job. If its own submission would be earlier, the job moves there and counts for
    /// this client. The job is small if it is small for one of them.
    pub(super) fn join(&mut self, generation: u64, client: &str, is_small: bool, start: Option<Tag>) {
        let Some((job, tag)) = self.extract(generation) else {
            return;
        };
        let is_small = is_small || job.is_small;
        let own = self.tag(client, job.cost, start);
        if own < tag {
            self.insert(generation, QueuedJob { client: client.to_owned(), is_small, ..job }, own);
        } else {
            self.insert(generation, QueuedJob { is_small, ..job }, tag);
        }
    }

    pub(super) fn remove(&mut self, generation: u64) {
        self.dequeue(generation);
    }

    /// Takes the next job for a slot of this kind.
    pub(super) fn take(&mut self, kind: SlotKind, now: Instant) -> Option<DequeuedJob> {
        let next = || self.least(kind).map(|(_, generation)| generation);
        let generation = self.overdue(kind, now).or_else(next)?;
        self.dequeue(generation)
    }

    /// Takes the next job of another client than this one, for a main or the guest slot.
    pub(super) fn take_other(&mut self, client: &str, now: Instant) -> Option<DequeuedJob> {
        let is_other = |generation: &u64| {
            let mut bands = self.bands(SlotKind::Main).filter_map(|band| band.by_age.get(generation));
            bands.any(|(job, _)| job.client != client)
        };
        let overdue = self.overdue(SlotKind::Main, now).filter(is_other);
        let others = self.clients.iter().filter(|(other, _)| *other != client);
        let least =
            others.filter_map(|(_, positions)| positions.first()).min().map(|(_, generation)| *generation);
        self.dequeue(overdue.or(least)?)
    }

    fn dequeue(&mut self, generation: u64) -> Option<DequeuedJob> {
        let (job, tag) = self.extract(generation)?;
        self.bytes -= job.bytes;
        self.cost -= job.cost;
        Some(DequeuedJob { generation, job, tag })
    }

    /// Advances the virtual time: a job with this tag runs. A parent does not run before its subtasks have succeeded.
    pub(super) fn advance(&mut self, tag: Tag) {
        // A small or overdue job that has passed others must not set back the clients that submit after it.
        let reached = self.least(SlotKind::Main).map_or(tag, |(waiting, _)| waiting.min(tag));
        self.virtual_time = self.virtual_time.max(reached);
    }

    /// The bands whose jobs a slot of this kind runs.
    fn bands(&self, kind: SlotKind) -> impl Iterator<Item = &Band> {
        std::iter::once(&self.small).chain((kind == SlotKind::Main).then_some(&self.other))
    }

    fn overdue(&self, kind: SlotKind, now: Instant) -> Option<u64> {
        let oldest = self.bands(kind).filter_map(|band| band.by_age.first_key_value());
        let (generation, (job, _)) = oldest.min_by_key(|(generation, _)| **generation)?;
        (now.saturating_duration_since(job.since) > self.overdue_after).then_some(*generation)
    }

    fn least(&self, kind: SlotKind) -> Option<Position> {
        self.bands(kind).filter_map(|band| band.by_tag.first()).min().copied()
    }

    fn tag(&self, client: &str, cost: f64, start: Option<Tag>) -> Tag {
        let last =
            || self.clients.get(client).and_then(BTreeSet::last).map_or(self.virtual_time, |(tag, _)| *tag);
        start.unwrap_or_else(|| self.virtual_time.max(last())).plus(cost)
    }

    fn insert(&mut self, generation: u64, job: QueuedJob, tag: Tag) {
        self.clients.entry(job.client.clone()).or_default().insert((tag, generation));
        let band = if job.is_small { &mut self.small } else { &mut self.other };
        band.by_tag.insert((tag, generation));
        band.by_age.insert(generation, (job, tag));
    }

    fn extract(&mut self, generation: u64) -> Option<(QueuedJob, Tag)> {
        let is_small = self.small.by_age.contains_key(&generation);
        let band = if is_small { &mut self.small } else { &mut self.other };
        let (job, tag) = band.by_age.remove(&generation)?;
        band.by_tag.remove(&(tag, generation));
        if let Some(positions) = self.clients.get_mut(&job.client) {
            positions.remove(&(tag, generation));
            if positions.is_empty() {
                self.clients.remove(&job.client);
            }
        }
        Some((job, tag))
    }
}
