//! `verne jobs`: lists and cancels the jobs of a running service.

use std::io::Write;

use axum::http::Uri;
use clap::{Args, Subcommand};
use form_urlencoded::Serializer;
use reqwest::blocking::{Client, RequestBuilder};
use serde_json::Value;
use verne_jobs::JobId;

use crate::process::cli::answer_format::AnswerFormat;
use crate::process::cli::service_address::{checked, root_cause};
use crate::process::cli::terminal::Terminal;
use crate::process::cli::words::jobs;

/// Jobs of a service.
#[derive(Debug, Args)]
pub(crate) struct JobsCommand {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// List the jobs, newest first, as GET /jobs does.
    List {
        #[command(flatten)]
        service: Service,
        /// List only jobs in this state: queued, running, succeeded, failed or cancelled.
        #[arg(long)]
        state: Option<String>,
        /// Maximum number of jobs, 1 to 100.
        #[arg(long, default_value_t = 50)]
        limit: usize,
        /// The `next` of the list before this one.
        #[arg(long, value_name = "NEXT")]
        after: Option<String>,
        #[command(flatten)]
        format: AnswerFormat,
    },
    /// Cancel a job, as DELETE /jobs/{id} does. The answer is the resulting state of the job.
    Cancel {
        /// Id of the job.
        id: JobId,
        #[command(flatten)]
        service: Service,
        #[command(flatten)]
        format: AnswerFormat,
    },
}

/// The service that has the jobs.
#[derive(Debug, Args)]
struct Service {
    /// Address of the service, with http or https, and with its --base-path if it has one.
    #[arg(long, env = "VERNE_URL", default_value = "http://127.0.0.1:8080")]
    url: Uri,
    /// API key, if the service needs one. Other users of the machine can read flags, but not the variable.
    #[arg(long, env = "VERNE_KEY", hide_env_values = true)]
    key: Option<String>,
}

impl JobsCommand {
    /// Writes the answer of the service to `out`.
    pub(crate) fn run(&self, out: &mut impl Write, terminal: Option<Terminal>) -> Result<(), String> {
        match &self.command {
            Command::List { service, state, limit, after, format } => {
                let mut query = Serializer::new(String::new());
                query.append_pair("limit", &limit.to_string());
                for (name, value) in [("state", state), ("after", after)] {
                    query.extend_pairs(value.iter().map(|value| (name, value)));
                }
                let answer = service.ask(&format!("/jobs?{}", query.finish()), Client::get)?;
                format.write(&answer, jobs::list, out, terminal)
            }
            Command::Cancel { id, service, format } => {
                let answer = service.ask(&format!("/jobs/{id}"), Client::delete)?;
                format.write(&answer, jobs::one, out, terminal)
            }
        }
    }
}

impl Service {
    /// The JSON that the service answers. A problem document becomes an error.
    fn ask(&self, path: &str, method: impl Fn(&Client, String) -> RequestBuilder) -> Result<Value, String> {
        let url = format!("{}{path}", checked(&self.url)?.to_string().trim_end_matches('/'));
        let unreachable = |error: reqwest::Error| format!("{url}: {}", root_cause(&error));
        let client = Client::builder().build().map_err(unreachable)?;
        let mut request = method(&client, url.clone());
        if let Some(key) = &self.key {
            request = request.bearer_auth(key);
        }
        let answer = request.send().map_err(unreachable)?;
        let (status, body) = (answer.status(), answer.bytes().map_err(unreachable)?);
        let body = serde_json::from_slice::<Value>(&body).ok();
        match body {
            Some(body) if status.is_success() => Ok(body),
            Some(problem) if problem["detail"].is_string() => {
                Err(format!("{url}: {status}: {}", problem["detail"].as_str().unwrap_or_default()))
            }
            _ => Err(format!("{url}: {status}: no answer of verne")),
        }
    }
}
