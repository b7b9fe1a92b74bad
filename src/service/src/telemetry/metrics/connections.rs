//! Metrics of connections: how many are open, and how many were rejected.

use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::gauge::Gauge;
use prometheus_client::registry::Registry;

use crate::telemetry::metrics::encoding::number;

/// Counts the connections of a listener. Clones share their counts.
#[derive(Clone, Default)]
pub(crate) struct ConnectionMetrics {
    open: Gauge,
    limit: Gauge,
    rejected: Counter,
}

/// An open connection. It is counted until it is dropped.
pub(crate) struct OpenConnection(Gauge);

impl ConnectionMetrics {
    /// Adds the metrics to a registry.
    pub(crate) fn register(&self, registry: &mut Registry) {
        registry.register("connections_open", "Open connections", self.open.clone());
        registry.register("connections_limit", "Limit of open connections", self.limit.clone());
        let rejected = "Connections rejected because of the total limit or the limit per address";
        registry.register("connections_refused", rejected, self.rejected.clone());
    }

    /// Sets the maximum number of open connections.
    pub(crate) fn set_limit(&self, connections: usize) {
        self.limit.set(number(connections));
    }

    /// Counts an open connection.
    pub(crate) fn open(&self) -> OpenConnection {
        self.open.inc();
        OpenConnection(self.open.clone())
    }

    /// Counts a rejected connection.
    pub(crate) fn count_rejection(&self) {
        self.rejected.inc();
    }
}

impl Drop for OpenConnection {
    fn drop(&mut self) {
        self.0.dec();
    }
}
