//! Metrics of the limits: what is in use, and what is possible.

use std::fmt;

use prometheus_client::encoding::{DescriptorEncoder, EncodeMetric};
use prometheus_client::metrics::TypedMetric;
use prometheus_client::metrics::gauge::ConstGauge;

use crate::limits::admission::Admission;
use crate::limits::usage::Usage;
use crate::telemetry::metrics::encoding::number;

/// The concurrency slots and the memory of requests.
pub(crate) fn encode_limits(encoder: &mut DescriptorEncoder<'_>, admission: &Admission) -> fmt::Result {
    let places = admission.permits();
    gauges(encoder, "places_taken", "Concurrency slots in use", &places, |usage| usage.taken)?;
    gauges(encoder, "places_limit", "Concurrency slots in total", &places, |usage| usage.limit)?;
    let memory = admission.memory();
    let taken = "Memory of request bodies and responses in transit";
    gauges(encoder, "memory_taken_bytes", taken, &memory, |usage| usage.taken)?;
    gauges(encoder, "memory_limit_bytes", "Limit of this memory", &memory, |usage| usage.limit)
}

/// One gauge for each limit; the label `of` names the limit.
fn gauges(
    encoder: &mut DescriptorEncoder<'_>,
    name: &str,
    help: &str,
    limits: &[Usage],
    value: fn(&Usage) -> u64,
) -> fmt::Result {
    let mut family = encoder.encode_descriptor(name, help, None, ConstGauge::<i64>::TYPE)?;
    for usage in limits {
        let metric = ConstGauge::new(number(value(usage)));
        metric.encode(family.encode_family(&[("of", usage.of)])?)?;
    }
    Ok(())
}
