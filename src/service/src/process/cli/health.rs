//! `verne health`: whether a service is ready, for containers that hold no other program to ask it with.

pub(crate) mod unverified;

use std::io::{self, Read, Write};
use std::net::{TcpStream, ToSocketAddrs};
use std::time::Duration;

use axum::http::Uri;
use clap::Args;

/// Longest that connecting, and each reading and writing, may take.
const PATIENCE: Duration = Duration::from_secs(3);

/// A probe on the command line.
#[derive(Debug, Args)]
pub(crate) struct HealthCommand {
    /// URL to request, with http or https. The certificate is not checked. A service that answers 200 is ready.
    #[arg(long, env = "VERNE_HEALTH_URL", default_value = "http://127.0.0.1:8080/readyz")]
    url: Uri,
}

impl HealthCommand {
    /// Returns where the service is ready; says what it is otherwise.
    pub(crate) fn run(&self) -> Result<(), String> {
        let status = self.status().map_err(|fault| format!("{}: {fault}", self.url))?;
        // "HTTP/1.1 200 OK"
        if status.split_ascii_whitespace().nth(1) == Some("200") {
            return Ok(());
        }
        Err(format!("{}: {status}", self.url))
    }

    /// The first line of the answer.
    fn status(&self) -> Result<String, String> {
        let authority = self.url.authority().ok_or("no host")?;
        let (host, port) = (authority.host().trim_matches(['[', ']']), authority.port_u16());
        let path = self.url.path_and_query().map_or("/", |path| path.as_str());
        let question = format!("GET {path} HTTP/1.1\r\nhost: {authority}\r\nconnection: close\r\n\r\n");
        let answer = match self.url.scheme_str() {
            Some("http") => first_line(connect(host, port.unwrap_or(80))?, &question),
            Some("https") => first_line(
                crate::process::cli::health::unverified::speak(host, connect(host, port.unwrap_or(443))?)?,
                &question,
            ),
            _ => return Err("not an http:// or https:// address".to_owned()),
        };
        answer.map_err(|fault| fault.to_string())
    }
}

fn first_line(mut stream: impl Read + Write, question: &str) -> io::Result<String> {
    stream.write_all(question.as_bytes())?;
    let mut start = [0; 128];
    let length = stream.read(&mut start)?;
    let text = String::from_utf8_lossy(&start[..length]);
    Ok(text.lines().next().unwrap_or("no answer").to_owned())
}

fn connect(host: &str, port: u16) -> Result<TcpStream, String> {
    let addresses = (host, port).to_socket_addrs().map_err(|fault| fault.to_string())?;
    let mut fault = "no address".to_owned();
    for address in addresses {
        match TcpStream::connect_timeout(&address, PATIENCE).and_then(|stream| {
            stream.set_read_timeout(Some(PATIENCE))?;
            stream.set_write_timeout(Some(PATIENCE))?;
            Ok(stream)
        }) {
            Ok(stream) => return Ok(stream),
            Err(error) => fault = error.to_string(),
        }
    }
    Err(fault)
}
