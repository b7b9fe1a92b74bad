//! Where the broker is and what it is shown: what can be wrong with that is known before it is asked.

use std::fmt::Display;
use std::path::Path;

use async_nats::rustls::RootCertStore;
use async_nats::rustls::crypto::aws_lc_rs;
use async_nats::rustls::pki_types::pem::PemObject;
use async_nats::rustls::pki_types::{CertificateDer, PrivateKeyDer};
use async_nats::rustls::sign::CertifiedKey;
use async_nats::{ConnectOptions, ServerAddr};
use nkeys::KeyPair;

use super::config::{Config, ConnectError, Setting};

/// How to connect, and to whom.
pub(super) type Access = (ConnectOptions, Vec<ServerAddr>);

impl Config {
    /// Refuses what no broker could take; connecting does as well.
    pub async fn check(&self) -> Result<(), ConnectError> {
        self.access().await.map(drop)
    }

    pub(super) async fn access(&self) -> Result<Access, ConnectError> {
        let config = self.clone();
        let looked_at = tokio::task::spawn_blocking(move || config.looked_at());
        looked_at.await.unwrap_or_else(|fault| Err(ConnectError::Threads(fault.to_string())))
    }

    fn looked_at(&self) -> Result<Access, ConnectError> {
        let fits = |character: char| character.is_ascii_alphanumeric() || "-_".contains(character);
        if self.name.is_empty() || !self.name.chars().all(fits) {
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
            let wrong = in_file(Setting::Credentials, path);
            let text = std::fs::read_to_string(path).map_err(|fault| wrong(&fault))?;
            options = options.credentials(&text).map_err(|fault| wrong(&fault))?;
        }
        if let Some(path) = &self.nkey {
            let wrong = in_file(Setting::Nkey, path);
            let seed = std::fs::read_to_string(path).map_err(|fault| wrong(&fault))?;
            let seed = seed.trim().to_owned();
            KeyPair::from_seed(&seed).map_err(|fault| wrong(&format!("no seed of an nkey: {fault}")))?;
            options = options.nkey(seed);
        }
        if let Some(path) = &self.authorities {
            let wrong = in_file(Setting::Authorities, path);
            let mut authorities = RootCertStore::empty();
            for authority in certificates(Setting::Authorities, path)? {
                authorities.add(authority).map_err(|fault| wrong(&fault))?;
            }
            options = options.add_root_certificates(path.clone()).require_tls(true);
        }
        if let Some((certificate, key)) = &self.certificate {
            let chain = certificates(Setting::Certificate, certificate)?;
            let secret = PrivateKeyDer::from_pem_file(key);
            let secret = secret.map_err(|fault| in_file(Setting::Key, key)(&fault))?;
            CertifiedKey::from_der(chain, secret, &aws_lc_rs::default_provider())
                .map_err(|fault| in_file(Setting::Key, key)(&fault))?;
            options = options.add_client_certificate(certificate.clone(), key.clone()).require_tls(true);
        }
        Ok(options)
    }
}

/// The address of one broker. What is wrong with it is told without it: it may hold a password.
fn server(address: &str) -> Result<ServerAddr, ConnectError> {
    let wrong = || {
        let reason = "nats://HOST or tls://HOST is needed, or several with commas between them".to_owned();
        unusable(Setting::Url, reason)
    };
    let server: ServerAddr = address.parse().map_err(|_| wrong())?;
    let is_broker = ["nats", "tls"].contains(&server.scheme()) && !server.host().is_empty();
    if is_broker { Ok(server) } else { Err(wrong()) }
}

/// The certificates of a file, at least one.
fn certificates(setting: Setting, path: &Path) -> Result<Vec<CertificateDer<'static>>, ConnectError> {
    let wrong = in_file(setting, path);
    let found = CertificateDer::pem_file_iter(path).and_then(Iterator::collect::<Result<Vec<_>, _>>);
    let found = found.map_err(|fault| wrong(&fault))?;
    if found.is_empty() { Err(wrong(&"there is no certificate in it")) } else { Ok(found) }
}

fn in_file(setting: Setting, path: &Path) -> impl Fn(&dyn Display) -> ConnectError {
    move |fault| unusable(setting, format!("{}: {fault}", path.display()))
}

fn unusable(setting: Setting, reason: String) -> ConnectError {
    ConnectError::Unusable { setting, reason }
}
