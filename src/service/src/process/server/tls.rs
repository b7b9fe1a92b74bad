//! TLS: the certificate, read again when its file changes.

use std::fmt;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use tokio::net::TcpStream;
use tokio::sync::watch;
use tokio_rustls::TlsAcceptor;
use tokio_rustls::rustls::crypto::aws_lc_rs;
use tokio_rustls::rustls::pki_types::pem::PemObject;
use tokio_rustls::rustls::pki_types::{CertificateDer, PrivateKeyDer};
use tokio_rustls::rustls::{self, ServerConfig};
use tokio_rustls::server::TlsStream;

/// The files are looked at this often: whatever renews a certificate need not tell us.
const FRESH: Duration = Duration::from_mins(1);

/// HTTP/2 as ALPN calls it.
const H2: &[u8] = b"h2";

/// And HTTP/1.
const H1: &[u8] = b"http/1.1";

/// Why there is no TLS.
#[derive(Debug)]
pub enum TlsError {
    /// This file cannot be read.
    File(PathBuf, io::Error),
    /// This file holds no certificates, or no key.
    Pem(PathBuf, rustls::pki_types::pem::Error),
    /// The certificate and the key of this file cannot be used.
    Pair(PathBuf, rustls::Error),
}

impl fmt::Display for TlsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(path, error) => write!(f, "{}: {error}", path.display()),
            Self::Pem(path, error) => write!(f, "{}: {error}", path.display()),
            Self::Pair(path, error) => {
                write!(f, "{}: cannot use this certificate and its key: {error}", path.display())
            }
        }
    }
}

impl std::error::Error for TlsError {}

/// What is in the two files, as PEM: the certificate with those that vouch for it, and its key.
type Pair = [Vec<u8>; 2];

/// The certificate in use.
pub(crate) struct Tls {
    files: [PathBuf; 2],
    /// What was read last, usable or not.
    read: watch::Sender<Pair>,
    /// What is in use.
    used: watch::Sender<Arc<ServerConfig>>,
}

impl Tls {
    /// Reads the certificate and its key.
    pub(crate) fn read(certificate: &Path, key: &Path) -> Result<Self, TlsError> {
        let files = [certificate.to_owned(), key.to_owned()];
        let pair = read(&files)?;
        let used = watch::Sender::new(Arc::new(usable(&files, &pair)?));
        Ok(Self { files, read: watch::Sender::new(pair), used })
    }

    /// Shakes hands, and offers HTTP/2 or not; with the stream, whether it was agreed on.
    pub(crate) async fn accept(
        &self,
        stream: TcpStream,
        http2: bool,
    ) -> io::Result<(TlsStream<TcpStream>, bool)> {
        let mut config = Arc::clone(&self.used.borrow());
        if !http2 {
            Arc::make_mut(&mut config).alpn_protocols = vec![H1.to_vec()];
        }
        let acceptor = TlsAcceptor::from(config);
        let stream = acceptor.accept(stream).await?;
        let http2 = stream.get_ref().1.alpn_protocol() == Some(H2);
        Ok((stream, http2))
    }

    /// Looks at the files. What cannot be used is refused once, and what was in use stays.
    fn refresh(&self) -> Result<bool, TlsError> {
        let pair = read(&self.files)?;
        let changed = self.read.send_if_modified(|read| {
            let changed = *read != pair;
            read.clone_from(&pair);
            changed
        });
        if changed {
            self.used.send_replace(Arc::new(usable(&self.files, &pair)?));
        }
        Ok(changed)
    }
}

/// Looks at the files now and again.
pub(crate) async fn keep_fresh(tls: Option<Arc<Tls>>) {
    let Some(tls) = tls else { return };
    loop {
        tokio::time::sleep(FRESH).await;
        let tls = Arc::clone(&tls);
        match tokio::task::spawn_blocking(move || tls.refresh()).await {
            Ok(Ok(true)) => tracing::info!("loaded a new certificate"),
            Ok(Err(error)) => {
                tracing::error!(%error, "cannot load the new certificate; the previous one stays in use");
            }
            Ok(Ok(false)) | Err(_) => {}
        }
    }
}

fn read(files: &[PathBuf; 2]) -> Result<Pair, TlsError> {
    let read = |path: &PathBuf| fs::read(path).map_err(|error| TlsError::File(path.clone(), error));
    Ok([read(&files[0])?, read(&files[1])?])
}

fn usable([certificate, key]: &[PathBuf; 2], [chain, secret]: &Pair) -> Result<ServerConfig, TlsError> {
    let chain = CertificateDer::pem_slice_iter(chain)
        .collect::<Result<Vec<_>, _>>()
        .map_err(|error| TlsError::Pem(certificate.clone(), error))?;
    let secret = PrivateKeyDer::from_pem_slice(secret).map_err(|error| TlsError::Pem(key.clone(), error))?;
    let unusable = |error| TlsError::Pair(certificate.clone(), error);
    // Named, not left to the process: a second provider among the dependencies would make rustls refuse to choose.
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
    fn a_new_certificate_is_taken_up_and_a_bad_one_is_not() {
        let place = TempDir::new().unwrap();
        let [certificate, key] = ["certificate.pem", "key.pem"].map(|name| place.path().join(name));
        assert!(matches!(Tls::read(&certificate, &key), Err(TlsError::File(..))));
        write(&certificate, &key);
        let tls = Tls::read(&certificate, &key).unwrap();
        let first = Arc::clone(&tls.used.borrow());
        assert!(!tls.refresh().unwrap());

        // Another certificate whose key is not there yet, then a broken key, then both files.
        write(&certificate, &place.path().join("other.pem"));
        assert!(matches!(tls.refresh(), Err(TlsError::Pair(..))));
        assert!(!tls.refresh().unwrap(), "the same failure is told once");
        fs::write(&key, "no key").unwrap();
        assert!(matches!(tls.refresh(), Err(TlsError::Pem(..))));
        assert!(Arc::ptr_eq(&first, &tls.used.borrow()));
        fs::copy(place.path().join("other.pem"), &key).unwrap();
        assert!(tls.refresh().unwrap());
        assert!(!Arc::ptr_eq(&first, &tls.used.borrow()));
    }
}
