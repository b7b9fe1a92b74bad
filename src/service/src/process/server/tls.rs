//! TLS of the listener: the certificate, and its reload when a file changes.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use thiserror::Error;
use tokio::net::TcpStream;
use tokio::sync::watch;
use tokio_rustls::TlsAcceptor;
use tokio_rustls::rustls::crypto::aws_lc_rs;
use tokio_rustls::rustls::pki_types::pem::PemObject;
use tokio_rustls::rustls::pki_types::{CertificateDer, PrivateKeyDer};
use tokio_rustls::rustls::{self, ServerConfig};
use tokio_rustls::server::TlsStream;

/// How often the service reads the files. So a program that renews the certificate need not notify the service.
const RELOAD_INTERVAL: Duration = Duration::from_mins(1);

/// The name of HTTP/2 in ALPN.
const H2: &[u8] = b"h2";

/// The name of HTTP/1.1 in ALPN.
const H1: &[u8] = b"http/1.1";

/// Why TLS cannot be used.
#[derive(Debug, Error)]
pub enum TlsError {
    /// This file is unreadable.
    #[error("{path}: {1}", path = .0.display())]
    File(PathBuf, io::Error),
    /// This file contains no certificate, or no key.
    #[error("{path}: {1}", path = .0.display())]
    Pem(PathBuf, rustls::pki_types::pem::Error),
    /// The certificate in this file and its key cannot be used.
    #[error("{path}: cannot use this certificate and its key: {1}", path = .0.display())]
    Pair(PathBuf, rustls::Error),
}

/// The contents of the two files in PEM: the certificate with its chain, and its key.
type Contents = [Vec<u8>; 2];

/// The certificate in use.
pub(crate) struct Tls {
    files: [PathBuf; 2],
    /// What was read last, usable or not.
    contents: watch::Sender<Contents>,
    /// The configuration for new connections.
    config: watch::Sender<Arc<ServerConfig>>,
}

impl Tls {
    /// Reads the certificate and its key.
    pub(crate) fn read(certificate: &Path, key: &Path) -> Result<Self, TlsError> {
        let files = [certificate.to_owned(), key.to_owned()];
        let contents = read(&files)?;
        let config = watch::Sender::new(Arc::new(server_config(&files, &contents)?));
        Ok(Self { files, contents: watch::Sender::new(contents), config })
    }

    /// Performs the handshake, and offers HTTP/2 if `http2`. Returns the stream and whether the client chose HTTP/2.
    pub(crate) async fn accept(
        &self,
        stream: TcpStream,
        http2: bool,
    ) -> io::Result<(TlsStream<TcpStream>, bool)> {
        let mut config = Arc::clone(&self.config.borrow());
        if !http2 {
            Arc::make_mut(&mut config).alpn_protocols = vec![H1.to_vec()];
        }
        let acceptor = TlsAcceptor::from(config);
        let stream = acceptor.accept(stream).await?;
        let http2 = stream.get_ref().1.alpn_protocol() == Some(H2);
        Ok((stream, http2))
    }

    /// Loads the files if they have changed, and returns whether they have. After an error the previous certificate
    /// stays in use, and the next call ignores the same contents.
    fn reload(&self) -> Result<bool, TlsError> {
        let new = read(&self.files)?;
        let changed = self.contents.send_if_modified(|contents| {
            let changed = *contents != new;
            contents.clone_from(&new);
            changed
        });
        if changed {
            self.config.send_replace(Arc::new(server_config(&self.files, &new)?));
        }
        Ok(changed)
    }
}

/// Reloads the files whenever they have changed.
pub(crate) async fn reload_on_change(tls: Arc<Tls>) {
    loop {
        tokio::time::sleep(RELOAD_INTERVAL).await;
        let tls = Arc::clone(&tls);
        match tokio::task::spawn_blocking(move || tls.reload()).await {
            Ok(Ok(true)) => tracing::info!("loaded a new certificate"),
            Ok(Err(error)) => {
                tracing::error!(%error, "cannot load the new certificate; the previous one stays in use");
            }
            Ok(Ok(false)) | Err(_) => {}
        }
    }
}

fn read(files: &[PathBuf; 2]) -> Result<Contents, TlsError> {
    let read = |path: &PathBuf| fs::read(path).map_err(|error| TlsError::File(path.clone(), error));
    Ok([read(&files[0])?, read(&files[1])?])
}

fn server_config(
    [certificate, key]: &[PathBuf; 2],
    [chain, secret]: &Contents,
) -> Result<ServerConfig, TlsError> {
    let chain = CertificateDer::pem_slice_iter(chain)
        .collect::<Result<Vec<_>, _>>()
        .map_err(|error| TlsError::Pem(certificate.clone(), error))?;
    let secret = PrivateKeyDer::from_pem_slice(secret).map_err(|error| TlsError::Pem(key.clone(), error))?;
    let unusable = |error| TlsError::Pair(certificate.clone(), error);
    // Explicit: if the dependencies contain two providers, rustls does not choose one.
    let mut config = ServerConfig::builder_with_provider(Arc::new(aws_lc_rs::default_provider()))
        .with_safe_default_protocol_versions()
        .map_err(unusable)?
        .with_no_client_auth()
        .with_single_cert(chain, secret)
        .map_err(unusable)?;
    config.alpn_protocols = vec![H2.to_vec(), H1.to_vec()];
    Ok(config)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use std::fs;
    use std::path::Path;
    use std::sync::Arc;

    use rcgen::{CertifiedKey, generate_simple_self_signed};
    use tempfile::TempDir;

    use super::{Tls, TlsError};

    fn write(certificate: &Path, key: &Path) {
        let CertifiedKey { cert, signing_key } =
            generate_simple_self_signed(["localhost".to_owned()]).unwrap();
        fs::write(certificate, cert.pem()).unwrap();
        fs::write(key, signing_key.serialize_pem()).unwrap();
    }

    #[test]
    fn a_new_certificate_is_loaded_and_a_broken_one_is_not() {
        let directory = TempDir::new().unwrap();
        let [certificate, key] = ["certificate.pem", "key.pem"].map(|name| directory.path().join(name));
        assert!(matches!(Tls::read(&certificate, &key), Err(TlsError::File(..))));
        write(&certificate, &key);
        let tls = Tls::read(&certificate, &key).unwrap();
        let first = Arc::clone(&tls.config.borrow());
        assert!(!tls.reload().unwrap());

        // First another certificate without its key, then a broken key, then the right key.
        write(&certificate, &directory.path().join("other.pem"));
        assert!(matches!(tls.reload(), Err(TlsError::Pair(..))));
        assert!(!tls.reload().unwrap(), "the same failure is reported once");
        fs::write(&key, "no key").unwrap();
        assert!(matches!(tls.reload(), Err(TlsError::Pem(..))));
        assert!(Arc::ptr_eq(&first, &tls.config.borrow()));
        fs::copy(directory.path().join("other.pem"), &key).unwrap();
        assert!(tls.reload().unwrap());
        assert!(!Arc::ptr_eq(&first, &tls.config.borrow()));
    }
}
