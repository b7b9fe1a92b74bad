//! Options of the connection to the broker. Defects of settings and files are found before the broker is asked.

use std::fmt::Display;
use std::path::Path;

use async_nats::rustls::RootCertStore;
use async_nats::rustls::crypto::aws_lc_rs;
use async_nats::rustls::pki_types::pem::PemObject;
use async_nats::rustls::pki_types::{CertificateDer, PrivateKeyDer};
use async_nats::rustls::sign::CertifiedKey;
use async_nats::{ConnectOptions, ServerAddr};

use super::config::{Config, ConnectError, Setting};

/// Options and servers of a connection.
pub(super) type Access = (ConnectOptions, Vec<ServerAddr>);

impl Config {
    /// Checks the settings without the broker. [`JetStream::connect`](crate::JetStream::connect) does too.
    ///
    /// # Errors
    ///
    /// [`ConnectError::Unusable`] with the first setting that no broker could accept.
    pub async fn check(&self) -> Result<(), ConnectError> {
        self.access().await.map(drop)
    }

    pub(super) async fn access(&self) -> Result<Access, ConnectError> {
        let config = self.clone();
        let read = tokio::task::spawn_blocking(move || config.read_access());
        read.await.unwrap_or_else(|error| Err(ConnectError::Threads(error.to_string())))
    }

    fn read_access(&self) -> Result<Access, ConnectError> {
        let is_allowed = |character: char| character.is_ascii_alphanumeric() || "-_".contains(character);
        if self.name.is_empty() || !self.name.chars().all(is_allowed) {
            let reason = format!("{:?}: a name of letters, digits, - and _ is needed", self.name);
            return Err(unusable(Setting::Name, reason));
        }
        let servers = self.url.split(',').map(|address| server(address.trim()));
        let servers = servers.collect::<Result<Vec<_>, _>>()?;
        Ok((self.options(&servers)?, servers))
    }

    fn options(&self, servers: &[ServerAddr]) -> Result<ConnectOptions, ConnectError> {
        let mut options = ConnectOptions::new().name(&self.name);
        if let Some(server) = servers.iter().find(|server| server.has_user_pass()) {
            let text = |part: Option<&str>| part.unwrap_or_default().to_owned();
            options = match server.password() {
                Some(_) => options.user_and_password(text(server.username()), text(server.password())),
                None => options.token(text(server.username())),
            };
        }
        if let Some(path) = &self.credentials {
            let unusable = in_file(Setting::Credentials, path);
            let text = std::fs::read_to_string(path).map_err(|error| unusable(&error))?;
            options = options.credentials(&text).map_err(|error| unusable(&error))?;
        }
        if let Some(path) = &self.nkey {
            options = options.nkey(seed(path)?);
        }
        if let Some(path) = &self.authorities {
            let unusable = in_file(Setting::Authorities, path);
            let mut authorities = RootCertStore::empty();
            for authority in certificates(Setting::Authorities, path)? {
                authorities.add(authority).map_err(|error| unusable(&error))?;
            }
            options = options.add_root_certificates(path.clone()).require_tls(true);
        }
        if let Some((certificate, key)) = &self.certificate {
            let unusable = in_file(Setting::Key, key);
            let chain = certificates(Setting::Certificate, certificate)?;
            let secret = PrivateKeyDer::from_pem_file(key).map_err(|error| unusable(&error))?;
            CertifiedKey::from_der(chain, secret, &aws_lc_rs::default_provider())
                .map_err(|error| unusable(&error))?;
            options = options.add_client_certificate(certificate.clone(), key.clone()).require_tls(true);
        }
        Ok(options)
    }
}

/// Parses the address of one server. The error does not contain the address, which may contain a password.
fn server(address: &str) -> Result<ServerAddr, ConnectError> {
    let invalid = || {
        let reason = "nats://HOST or tls://HOST is needed, or several with commas between them".to_owned();
        unusable(Setting::Url, reason)
    };
    let server: ServerAddr = address.parse().map_err(|_| invalid())?;
    let is_broker = ["nats", "tls"].contains(&server.scheme()) && !server.host().is_empty();
    if is_broker { Ok(server) } else { Err(invalid()) }
}

/// Reads the seed of an nkey. The client library checks a seed in a file of credentials at once, but a seed alone only
/// when it connects; so the seed is checked as a part of credentials.
fn seed(path: &Path) -> Result<String, ConnectError> {
    let unusable = in_file(Setting::Nkey, path);
    let text = std::fs::read_to_string(path).map_err(|error| unusable(&error))?;
    let seed = text.trim().to_owned();
    let credentials =
        format!("---BEGIN JWT---\nnone\n---END JWT---\n\n---BEGIN SEED---\n{seed}\n---END SEED---\n");
    let checked = ConnectOptions::new().credentials(&credentials);
    checked.map_err(|error| unusable(&format!("not the seed of an nkey: {error}")))?;
    Ok(seed)
}

/// Reads the certificates of a file, at least one.
fn certificates(setting: Setting, path: &Path) -> Result<Vec<CertificateDer<'static>>, ConnectError> {
    let unusable = in_file(setting, path);
    let found = CertificateDer::pem_file_iter(path).and_then(Iterator::collect::<Result<Vec<_>, _>>);
    let found = found.map_err(|error| unusable(&error))?;
    if found.is_empty() { Err(unusable(&"the file contains no certificate")) } else { Ok(found) }
}

fn in_file(setting: Setting, path: &Path) -> impl Fn(&dyn Display) -> ConnectError {
    move |error| unusable(setting, format!("{}: {error}", path.display()))
}

fn unusable(setting: Setting, reason: String) -> ConnectError {
    ConnectError::Unusable { setting, reason }
}
