//! What is taken of what is bounded.

use std::fmt;
use std::sync::Arc;

use prometheus_client::collector::Collector;
use prometheus_client::encoding::{DescriptorEncoder, EncodeMetric};
use prometheus_client::metrics::TypedMetric;
use prometheus_client::metrics::gauge::ConstGauge;

use crate::limits::admission::Admission;
use crate::limits::admission::usage::Usage;
use crate::telemetry::metrics::number;

/// The places and the memory of requests.
#[derive(Debug)]
pub(crate) struct Bounds(pub Arc<Admission>);

impl Collector for Bounds {
    fn encode(&self, mut encoder: DescriptorEncoder<'_>) -> fmt::Result {
        let places = self.0.places();
        gauges(&mut encoder, "places_taken", "Concurrency slots in use", &places, |usage| usage.taken)?;
        gauges(&mut encoder, "places_limit", "Concurrency slots in total", &places, |usage| usage.limit)?;
        let memory = self.0.memory();
        let taken = "Memory of request bodies and responses in transit";
        gauges(&mut encoder, "memory_taken_bytes", taken, &memory, |usage| usage.taken)?;
        gauges(&mut encoder, "memory_limit_bytes", "Limit of this memory", &memory, |usage| usage.limit)
    }
}

fn gauges(
    encoder: &mut DescriptorEncoder<'_>,
    name: &str,
    help: &str,
    bounds: &[Usage],
    value: fn(&Usage) -> u64,
) -> fmt::Result {
    let mut family = encoder.encode_descriptor(name, help, None, ConstGauge::<i64>::TYPE)?;
    for usage in bounds {
        let metric = ConstGauge::new(number(value(usage)));
        metric.encode(family.encode_family(&[("of", usage.of)])?)?;
    }
    Ok(())
}
