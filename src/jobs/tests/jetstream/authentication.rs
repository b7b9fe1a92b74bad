//! Passwords, keys and certificates, and settings that cannot be used.

use std::fs;
use std::path::Path;
use std::process::Command;

use tempfile::TempDir;
use verne_jobs::JetStream;
use verne_jobs::jetstream::{Config, ConnectError, Setting};

use crate::broker::Broker;
use crate::fixture::{broker_tests, timed_tests};

timed_tests!(unusable_names_and_addresses_are_errors, unusable_files_are_errors,);

broker_tests!(
    a_correct_password_is_accepted,
    a_correct_nkey_is_accepted,
    a_correct_client_certificate_is_accepted,
);

async fn a_correct_password_is_accepted() {
    let broker = Broker::with("authorization { user: ada, password: secret }");
    let config = broker.config();
    assert!(matches!(JetStream::connect(config.clone()).await.err(), Some(ConnectError::Refused(_))));
    let wrong = config.url.replace("nats://", "nats://ada:wrong@");
    let refused = JetStream::connect(Config { url: wrong, ..config.clone() }).await.err();
    assert!(matches!(refused, Some(ConnectError::Refused(_))));
    let url = config.url.replace("nats://", "nats://ada:secret@");
    assert!(JetStream::connect(Config { url, ..config }).await.is_ok());
}

/// The keys are those of the broker's manual.
async fn a_correct_nkey_is_accepted() {
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

async fn unusable_names_and_addresses_are_errors() {
    let nowhere = Config::at("nats://127.0.0.1:1");
    assert_eq!(nowhere.check().await, Ok(()));
    assert!(matches!(JetStream::connect(nowhere.clone()).await.err(), Some(ConnectError::Broker(_))));
    let name = Config { name: "a.b".to_owned(), ..nowhere };
    assert_unusable(name, Setting::Name, "a.b").await;
    for url in ["", "http://one", "nats://", "nats://me:secret@one:port", "nats://one,foo://me:secret@two"] {
        assert_unusable(Config::at(url), Setting::Url, "nats://HOST").await;
    }
}

/// Connecting returns the same error, though the broker does not exist.
async fn assert_unusable(config: Config, unusable: Setting, expected: &str) {
    let Some(ConnectError::Unusable { setting, reason }) = JetStream::connect(config.clone()).await.err()
    else {
        panic!("{config:?}")
    };
    assert_eq!(setting, unusable, "{reason}");
    assert!(reason.contains(expected) && !reason.contains("secret"), "{reason}");
    assert_eq!(config.check().await, Err(ConnectError::Unusable { setting, reason }));
}

async fn unusable_files_are_errors() {
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

/// Makes `NAME.pem` and `NAME.key`, signed by `signer` or by itself.
fn certify(directory: &Path, name: &str, signer: Option<&str>) {
    let file = |name: &str, kind: &str| directory.join(format!("{name}.{kind}")).display().to_string();
    let [subject, key, certificate] = [format!("/CN={name}"), file(name, "key"), file(name, "pem")];
    let mut command = Command::new("openssl");
    command.args("req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 1".split(' '));
    command.args(["-subj", &subject, "-keyout", &key, "-out", &certificate]);
    if let Some(signer) = signer {
        command.args(["-CA", &file(signer, "pem"), "-CAkey", &file(signer, "key")]);
        command.args(
            "-addext subjectAltName=IP:127.0.0.1 -addext basicConstraints=critical,CA:FALSE".split(' '),
        );
    }
    assert!(command.output().unwrap().status.success());
}

async fn a_correct_client_certificate_is_accepted() {
    let directory = TempDir::new().unwrap();
    let directory = directory.path();
    certify(directory, "ca", None);
    certify(directory, "broker", Some("ca"));
    certify(directory, "client", Some("ca"));
    let path = |name: &str| directory.join(name);
    let ca = path("ca.pem");
    let [certificate, key, authority] =
        [path("broker.pem"), path("broker.key"), ca.clone()].map(|path| path.display().to_string());
    let files = format!("cert_file: \"{certificate}\", key_file: \"{key}\", ca_file: \"{authority}\"");
    let tls = format!("tls {{ {files}, verify: true }}");
    let broker = Broker::with(&tls);
    let known = Config { authorities: Some(ca), ..broker.config() };
    assert!(matches!(JetStream::connect(broker.config()).await.err(), Some(ConnectError::Broker(_))));
    assert!(matches!(JetStream::connect(known.clone()).await.err(), Some(ConnectError::Broker(_))));
    let certificate = Some((path("client.pem"), path("client.key")));
    assert!(JetStream::connect(Config { certificate, ..known }).await.is_ok());
}
