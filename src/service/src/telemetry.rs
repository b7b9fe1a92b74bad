//! Log, metrics and traces.
//!
//! May import `limits` and `wire`.

#[cfg(test)]
pub(crate) mod captured_log;
pub(crate) mod metrics;

use std::io::{IsTerminal, stderr};

use clap::{Args, ValueEnum};
use opentelemetry::global;
use opentelemetry::trace::TracerProvider;
use opentelemetry_otlp::{SpanExporter, WithExportConfig};
use opentelemetry_sdk::Resource;
use opentelemetry_sdk::propagation::TraceContextPropagator;
use opentelemetry_sdk::trace::SdkTracerProvider;
use tracing_subscriber::layer::SubscriberExt;
use tracing_subscriber::util::SubscriberInitExt;
use tracing_subscriber::{EnvFilter, Layer};

/// The settings of the log and the traces.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Log and traces")]
pub struct TelemetryConfig {
    /// Format of the log on standard error. `RUST_LOG` sets its level.
    #[arg(long, env = "VERNE_LOG_FORMAT", value_enum, default_value_t)]
    pub log_format: LogFormat,
    /// Trace collector that accepts OTLP over HTTP: <http://HOST:4318>. By default the process sends no traces.
    #[arg(long, env = "VERNE_OTLP", value_name = "URL", hide_env_values = true)]
    pub otlp: Option<String>,
}

/// A format of the log.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum LogFormat {
    /// Lines of text.
    #[default]
    Text,
    /// One JSON object per line.
    Json,
}

/// The telemetry of the process. When it is dropped, it sends the last traces.
#[must_use = "dropping it ends the traces"]
pub(crate) struct Telemetry(Option<SdkTracerProvider>);

impl TelemetryConfig {
    /// Starts the log and the traces of the process. Call it once, outside of the async runtime.
    pub(crate) fn start(&self) -> Result<Telemetry, String> {
        let filter = || EnvFilter::try_from_default_env().unwrap_or_else(|_| EnvFilter::new("info"));
        let log = tracing_subscriber::fmt::layer().with_writer(stderr).with_ansi(stderr().is_terminal());
        let log = match self.log_format {
            LogFormat::Text => log.with_filter(filter()).boxed(),
            LogFormat::Json => log.json().flatten_event(true).with_filter(filter()).boxed(),
        };
        let provider = self.otlp.as_deref().map(provider_for).transpose()?;
        let traces = provider.as_ref().map(|provider| {
            global::set_text_map_propagator(TraceContextPropagator::new());
            tracing_opentelemetry::layer().with_tracer(provider.tracer("verne")).with_filter(filter())
        });
        tracing_subscriber::registry().with(log).with(traces).init();
        Ok(Telemetry(provider))
    }
}

fn provider_for(url: &str) -> Result<SdkTracerProvider, String> {
    let endpoint = format!("{}/v1/traces", url.trim_end_matches('/'));
    let exporter = SpanExporter::builder().with_http().with_endpoint(endpoint).build();
    let exporter = exporter.map_err(|error| format!("otlp: {error}"))?;
    let resource = Resource::builder().with_service_name("verne").build();
    Ok(SdkTracerProvider::builder().with_batch_exporter(exporter).with_resource(resource).build())
}

impl Drop for Telemetry {
    fn drop(&mut self) {
        if let Some(Err(error)) = self.0.take().map(|provider| provider.shutdown()) {
            tracing::warn!(%error, "cannot send the last traces");
        }
    }
}
