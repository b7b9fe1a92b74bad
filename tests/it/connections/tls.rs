//! HTTPS.

use std::fs;
use std::sync::Arc;

use axum::http::StatusCode;
use rcgen::{CertifiedKey, generate_simple_self_signed};
use tempfile::TempDir;
use tokio::io::AsyncWriteExt;
use tokio::net::TcpStream;
use tokio_rustls::TlsConnector;
use tokio_rustls::client::TlsStream;
use tokio_rustls::rustls::crypto::aws_lc_rs;
use tokio_rustls::rustls::{ClientConfig, RootCertStore};

use super::http2::{http2, question};
use super::{Served, in_time, rest, serve};
use crate::cli::verne;

/// A service with a certificate of its own, and a client that trusts it and speaks these protocols.
async fn secured(flags: &str) -> (Served, impl AsyncFn(&[&str]) -> TlsStream<TcpStream>) {
    let place = TempDir::new().unwrap();
    let [certificate, key] = ["certificate.pem", "key.pem"].map(|name| place.path().join(name));
    let CertifiedKey { cert, signing_key } = generate_simple_self_signed(["localhost".to_owned()]).unwrap();
    fs::write(&certificate, cert.pem()).unwrap();
    fs::write(&key, signing_key.serialize_pem()).unwrap();
    let (certificate, key) = (certificate.display(), key.display());
    let served = serve(&format!("--tls-certificate {certificate} --tls-key {key} {flags}")).await;
    let mut trusted = RootCertStore::empty();
    trusted.add(cert.der().clone()).unwrap();
    let address = served.address;
    let connect = async move |protocols: &[&str]| {
        // The files are read when the service starts; this keeps them until then.
        let _place = &place;
        let mut config = ClientConfig::builder_with_provider(Arc::new(aws_lc_rs::default_provider()))
            .with_safe_default_protocol_versions()
            .unwrap()
            .with_root_certificates(trusted.clone())
            .with_no_client_auth();
        config.alpn_protocols = protocols.iter().map(|name| name.as_bytes().to_vec()).collect();
        let stream = TcpStream::connect(address).await.unwrap();
        let name = "localhost".try_into().unwrap();
        in_time(TlsConnector::from(Arc::new(config)).connect(name, stream)).await.unwrap()
    };
    (served, connect)
}

#[tokio::test]
async fn tls_serves_http1_and_http2() {
    let (served, connect) = secured("").await;
    for protocols in [&["http/1.1"] as &[&str], &[]] {
        let mut stream = connect(protocols).await;
        stream
            .write_all(b"GET /livez HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
            .await
            .unwrap();
        let answer = rest(&mut stream).await;
        assert!(answer.starts_with("HTTP/1.1 200 OK"), "{answer}");
        assert!(answer.contains("strict-transport-security: max-age="), "{answer}");
    }
    let stream = connect(&["h2", "http/1.1"]).await;
    assert_eq!(stream.get_ref().1.alpn_protocol(), Some(b"h2".as_slice()));
    let (mut client, _) = http2(stream).await;
    assert_eq!(in_time(client.send_request(question())).await.unwrap().status(), StatusCode::OK);
    drop(client);
    served.end().await;
}

#[tokio::test]
async fn a_half_closed_tls_client_is_answered() {
    let (served, connect) = secured("").await;
    let mut stream = connect(&["http/1.1"]).await;
    stream.write_all(b"GET /workspace?tolerance=20 HTTP/1.1\r\nHost: localhost\r\n\r\n").await.unwrap();
    stream.shutdown().await.unwrap();
    let answer = rest(&mut stream).await.replace("HTTP/1.1 100 Continue\r\n\r\n", "");
    assert!(answer.starts_with("HTTP/1.1 200 OK"), "{answer}");
    served.end().await;
}

#[tokio::test]
async fn silent_tls_clients_are_disconnected() {
    let (served, connect) = secured("--header-timeout 1").await;
    let mut silent = served.connect().await;
    let mut plain = served.connect().await;
    plain.write_all(b"GET /livez HTTP/1.1\r\nHost: localhost\r\n\r\n").await.unwrap();
    let (mut one, mut two) = (connect(&["http/1.1"]).await, connect(&["h2"]).await);
    assert_eq!(rest(&mut silent).await, "");
    assert!(!rest(&mut plain).await.contains("HTTP/1.1 200"));
    assert!(!rest(&mut one).await.contains(" 200 "));
    assert!(!rest(&mut two).await.contains(" 200 "));
    served.end().await;
}

#[tokio::test]
async fn tls_probes_are_answered_at_the_connection_limit() {
    let (served, connect) = secured("--max-connections 1").await;
    let (mut first, _) = http2(connect(&["h2"]).await).await;
    assert_eq!(in_time(first.send_request(question())).await.unwrap().status(), StatusCode::OK);
    for (path, status) in [("/livez", "200 OK"), ("/readyz", "200 OK"), ("/machines", "503 ")] {
        let mut stream = connect(&["h2", "http/1.1"]).await;
        assert_eq!(stream.get_ref().1.alpn_protocol(), Some(b"http/1.1".as_slice()));
        let request = format!("GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\n");
        stream.write_all(request.as_bytes()).await.unwrap();
        let answer = rest(&mut stream).await;
        assert!(answer.starts_with(&format!("HTTP/1.1 {status}")), "{answer}");
    }
    drop(first);
    served.end().await;
}

#[tokio::test]
async fn the_health_command_uses_https() {
    let (served, _connect) = secured("").await;
    let line = format!("health --url https://{}/readyz", served.address);
    assert_eq!(tokio::task::spawn_blocking(move || verne(&line)).await.unwrap(), Ok(String::new()));
    served.end().await;
    let plain = serve("").await;
    let line = format!("health --url https://{}/readyz", plain.address);
    assert!(tokio::task::spawn_blocking(move || verne(&line)).await.unwrap().is_err());
    plain.end().await;
}
