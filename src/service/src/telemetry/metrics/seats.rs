//! Those who run jobs in this process.

use std::fmt;

use prometheus_client::collector::Collector;
use prometheus_client::encoding::DescriptorEncoder;
use verne_jobs::Slots;
use verne_jobs::jetstream::Occupancy;

use crate::telemetry::metrics::{counter, gauge, number};

/// The queue of one process.
pub(crate) struct Here(pub Box<dyn Fn() -> Slots + Send + Sync>);

/// A worker at a broker.
pub(crate) struct OfWorker(pub Box<dyn Fn() -> Occupancy + Send + Sync>);

impl fmt::Debug for Here {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Here")
    }
}

impl Collector for Here {
    fn encode(&self, mut encoder: DescriptorEncoder<'_>) -> fmt::Result {
        seats(&mut encoder, (self.0)())
    }
}

impl fmt::Debug for OfWorker {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("OfWorker")
    }
}

impl Collector for OfWorker {
    fn encode(&self, mut encoder: DescriptorEncoder<'_>) -> fmt::Result {
        let now = (self.0)();
        seats(&mut encoder, now.slots)?;
        let redelivered = "Jobs redelivered after the loss of a worker";
        counter(&mut encoder, "worker_redeliveries", redelivered, now.redelivered)?;
        let handed_back = "Jobs that this worker returned to the queue";
        counter(&mut encoder, "worker_handed_back", handed_back, now.handed_back)
    }
}

fn seats(encoder: &mut DescriptorEncoder<'_>, seats: Slots) -> fmt::Result {
    gauge(encoder, "worker_seats", "Job slots of this process", number(seats.total))?;
    gauge(encoder, "worker_seats_busy", "Job slots in use", number(seats.busy))
}
