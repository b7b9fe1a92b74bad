//! Connections: how many are open, and how many were turned away.

use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::gauge::Gauge;
use prometheus_client::registry::Registry;

use crate::telemetry::metrics::number;

/// Counts the connections of a listener. Its clones are one.
#[derive(Clone, Default)]
pub(crate) struct Connections {
    open: Gauge,
    limit: Gauge,
    refused: Counter,
}

/// A connection that is open.
pub(crate) struct Open(Gauge);

impl Connections {
    /// Told of in a registry.
    pub(crate) fn register(&self, registry: &mut Registry) {
        registry.register("connections_open", "Open connections", self.open.clone());
        registry.register("connections_limit", "Limit of open connections", self.limit.clone());
        let refused = "Connections rejected because of the total limit or the limit per address";
        registry.register("connections_refused", refused, self.refused.clone());
    }

    /// At most so many are open.
    pub(crate) fn limit(&self, connections: usize) {
        self.limit.set(number(connections));
    }

    /// One has come; it is open until the answer is dropped.
    pub(crate) fn open(&self) -> Open {
        self.open.inc();
        Open(self.open.clone())
    }

    /// One has come for which there is no place.
    pub(crate) fn refuse(&self) {
        self.refused.inc();
    }
}

impl Drop for Open {
    fn drop(&mut self) {
        self.0.dec();
    }
}
