//! Who may, and what cannot be.

use std::fs;
use std::path::Path;
use std::process::Command;

use tempfile::TempDir;
use verne_jobs::JetStream;
use verne_jobs::jetstream::{Config, ConnectError, Setting};

use crate::broker::Broker;

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn a_password_lets_in() {
    let broker = Broker::with("authorization { user: ada, password: secret }");
    let config = broker.config();
    assert!(matches!(JetStream::connect(config.clone()).await.err(), Some(ConnectError::Refused(_))));
    let wrong = config.url.replace("nats://", "nats://ada:wrong@");
    let refused = JetStream::connect(Config { url: wrong, ..config.clone() }).await.err();
    assert!(matches!(refused, Some(ConnectError::Refused(_))));
    let url = config.url.replace("nats://", "nats://ada:secret@");
    assert!(JetStream::connect(Config { url, ..config }).await.is_ok());
}

/// The pair of keys is the one of the broker's manual.
#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn a_key_lets_in() {
    let public = "UDXU4RCSJNZOIQHZNWXHXORDPRTGNJAHAHFRGZNEEJCPQTT2M7NLCNF4";
    let broker = Broker::with(&format!("authorization {{ users: [ {{ nkey: {public} }} ] }}"));
    let directory = TempDir::new().unwrap();
    let seed = directory.path().join("seed");
    fs::write(&seed, "SUACSSL3UAHUDXKFSNVUZRF5UHPMWZ6BFDTJ7M6USDXIEDNPPQYYYCU3VY\n").unwrap();
    let config = broker.config();
    assert!(matches!(JetStream::connect(config.clone()).await.err(), Some(ConnectError::Refused(_))));
    assert!(JetStream::connect(Config { nkey: Some(seed.clone()), ..config.clone() }).await.is_ok());
    fs::remove_file(&seed).unwrap();
    let missing = JetStream::connect(Config { nkey: Some(seed.clone()), ..config }).await.err();
    assert!(matches!(missing, Some(ConnectError::Unusable { setting: Setting::Nkey, .. })));
}

#[tokio::test]
async fn what_cannot_be_is_told() {
    let nowhere = Config::at("nats://127.0.0.1:1");
    assert_eq!(nowhere.check().await, Ok(()));
    assert!(matches!(JetStream::connect(nowhere.clone()).await.err(), Some(ConnectError::Broker(_))));
    let name = Config { name: "a.b".to_owned(), ..nowhere };
    assert_unusable(name, Setting::Name, "a.b").await;
    for url in ["", "http://one", "nats://", "nats://me:secret@one:port", "nats://one,foo://me:secret@two"] {
        assert_unusable(Config::at(url), Setting::Url, "nats://HOST").await;
    }
}

/// Connecting says so as well, rather than that the broker is not there.
async fn assert_unusable(config: Config, unusable: Setting, told: &str) {
    let Some(ConnectError::Unusable { setting, reason }) = JetStream::connect(config.clone()).await.err()
    else {
        panic!("{config:?}")
    };
    assert_eq!(setting, unusable, "{reason}");
    assert!(reason.contains(told) && !reason.contains("secret"), "{reason}");
    assert_eq!(config.check().await, Err(ConnectError::Unusable { setting, reason }));
}

#[tokio::test]
async fn files_that_cannot_be_used_are_told() {
    let directory = TempDir::new().unwrap();
    let directory = directory.path();
    certify(directory, "one", None);
    certify(directory, "two", None);
    let path = |name: &str| directory.join(name);
    fs::write(path("empty"), "").unwrap();
    let nowhere = Config::at("nats://127.0.0.1:1");
    let pair =
        |certificate, key| Config { certificate: Some((path(certificate), path(key))), ..nowhere.clone() };
    for file in ["missing", "empty", "one.key"] {
        let with = Some(path(file));
        let authorities = Config { authorities: with.clone(), ..nowhere.clone() };
        assert_unusable(authorities, Setting::Authorities, file).await;
        let nkey = Config { nkey: with.clone(), ..nowhere.clone() };
        assert_unusable(nkey, Setting::Nkey, file).await;
        let credentials = Config { credentials: with, ..nowhere.clone() };
        assert_unusable(credentials, Setting::Credentials, file).await;
        assert_unusable(pair(file, "one.key"), Setting::Certificate, file).await;
    }
    for file in ["missing", "empty", "one.pem", "two.key"] {
        assert_unusable(pair("one.pem", file), Setting::Key, file).await;
    }
    let usable = Config { authorities: Some(path("two.pem")), ..pair("one.pem", "one.key") };
    assert_eq!(usable.check().await, Ok(()));
}

/// Makes `NAME.pem` and `NAME.key`, signed by `ca`, or by itself.
fn certify(directory: &Path, name: &str, signer: Option<&str>) {
    let file = |name: &str, kind: &str| directory.join(format!("{name}.{kind}")).display().to_string();
    let mut command = Command::new("openssl");
    command.args([
        "req",
        "-x509",
        "-newkey",
        "ec",
        "-pkeyopt",
        "ec_paramgen_curve:prime256v1",
        "-nodes",
        "-days",
        "1",
    ]);
    command.args([
        "-subj",
        &format!("/CN={name}"),
        "-keyout",
        &file(name, "key"),
        "-out",
        &file(name, "pem"),
    ]);
    if let Some(signer) = signer {
        command.args(["-CA", &file(signer, "pem"), "-CAkey", &file(signer, "key")]);
        command.args([
            "-addext",
            "subjectAltName=IP:127.0.0.1",
            "-addext",
            "basicConstraints=critical,CA:FALSE",
        ]);
    }
    assert!(command.output().unwrap().status.success());
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn certificates_let_in() {
    let directory = TempDir::new().unwrap();
    let directory = directory.path();
    certify(directory, "ca", None);
    certify(directory, "broker", Some("ca"));
    certify(directory, "client", Some("ca"));
    let path = |name: &str| directory.join(name);
    let [certificate, key, ca] = [path("broker.pem"), path("broker.key"), path("ca.pem")];
    let tls =
        format!("tls {{ cert_file: {certificate:?}, key_file: {key:?}, ca_file: {ca:?}, verify: true }}");
    let broker = Broker::with(&tls);
    let known = Config { authorities: Some(ca), ..broker.config() };
    assert!(matches!(JetStream::connect(broker.config()).await.err(), Some(ConnectError::Broker(_))));
    assert!(matches!(JetStream::connect(known.clone()).await.err(), Some(ConnectError::Broker(_))));
    let certificate = Some((path("client.pem"), path("client.key")));
    assert!(JetStream::connect(Config { certificate, ..known }).await.is_ok());
}
