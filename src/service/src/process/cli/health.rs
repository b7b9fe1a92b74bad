//! `verne health`: asks a service whether it is ready. The container image has no other program for this.

use std::time::Duration;

use axum::http::Uri;
use clap::Args;
use reqwest::StatusCode;
use reqwest::blocking::Client;
use reqwest::redirect::Policy;

use crate::process::cli::service_address::{checked, root_cause};

/// How long the service may take to answer.
const TIMEOUT: Duration = Duration::from_secs(3);

/// The probe.
#[derive(Debug, Args)]
pub(crate) struct HealthCommand {
    /// URL to request, with http or https. The certificate is not checked. A service that answers 200 is ready.
    #[arg(long, env = "VERNE_HEALTH_URL", default_value = "http://127.0.0.1:8080/readyz")]
    url: Uri,
}

impl HealthCommand {
    /// Fails if the service is not ready, and names the reason.
    pub(crate) fn run(&self) -> Result<(), String> {
        checked(&self.url)?;
        match self.status() {
            Ok(StatusCode::OK) => Ok(()),
            Ok(status) => Err(format!("{}: {status}", self.url)),
            Err(error) => Err(format!("{}: {}", self.url, root_cause(&error))),
        }
    }

    fn status(&self) -> reqwest::Result<StatusCode> {
        // A probe of the own host: its certificate names another host, and an expired one is no reason for a restart.
        let client = Client::builder().tls_danger_accept_invalid_certs(true);
        let client = client.timeout(TIMEOUT).no_proxy().redirect(Policy::none()).build()?;
        Ok(client.get(self.url.to_string()).send()?.status())
    }
}
