//! Metrics of computations: their number, kind and duration.

use std::time::Duration;

use prometheus_client::encoding::EncodeLabelSet;
use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::family::Family;
use prometheus_client::metrics::histogram::Histogram;
use prometheus_client::registry::{Registry, Unit};

/// Upper bounds of the histogram in seconds: from a small workspace to a large dexterity map.
const BOUNDS: [f64; 14] =
    [0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0, 60.0, 600.0, 3_600.0];

/// Counts computations. Clones share their counts.
#[derive(Clone)]
pub(crate) struct ComputationMetrics {
    computed: Counter,
    seconds: Family<Run, Histogram, fn() -> Histogram>,
}

/// The labels of a run of a job or of a subtask.
#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
struct Run {
    kind: &'static str,
    outcome: &'static str,
}

impl Default for ComputationMetrics {
    fn default() -> Self {
        let histogram: fn() -> Histogram = || Histogram::new(BOUNDS);
        Self { computed: Counter::default(), seconds: Family::new_with_constructor(histogram) }
    }
}

impl ComputationMetrics {
    /// Adds the metrics to a registry.
    pub(crate) fn register(&self, registry: &mut Registry) {
        registry.register("computations", "Workspaces and subtasks of maps computed", self.computed.clone());
        let seconds = "Run time of jobs and of their subtasks, including runs that find a stored result";
        registry.register_with_unit("job_run", seconds, Unit::Seconds, self.seconds.clone());
    }

    /// Counts a computation. A run that finds a stored result computes nothing.
    pub(crate) fn count(&self) {
        self.computed.inc();
    }

    /// Counts a run of a job or of a subtask.
    pub(crate) fn ran(&self, kind: &'static str, outcome: &'static str, time: Duration) {
        self.seconds.get_or_create(&Run { kind, outcome }).observe(time.as_secs_f64());
    }
}
