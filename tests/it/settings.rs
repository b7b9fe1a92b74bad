//! Settings of `verne serve`: from a file, and as they are printed.

use std::fs;
use std::path::PathBuf;

use tempfile::TempDir;
use verne_service::Service;

use crate::cli::verne;
use crate::http::settings;

/// A file of settings; the directory lives as long as it is wanted.
fn file(text: &str) -> (TempDir, PathBuf) {
    let place = TempDir::new().unwrap();
    let path = place.path().join("verne.toml");
    fs::write(&path, text).unwrap();
    (place, path)
}

#[test]
fn flags_override_the_settings_file() {
    let (_place, path) = file("queue = 7\nwait = 3\nmemory_only = true\n");
    for command in ["serve", ""] {
        let printed =
            verne(&format!("{command} --config {} --wait 4 --print-config", path.display())).unwrap();
        for line in [
            "queue = 7 # file ",
            "wait = 4 # flag --wait",
            "memory_only = true # file ",
            "drain = 10 # default",
            "listen = \"localhost:8080\" # default",
            "base_path = \"\" # default",
        ] {
            assert!(printed.lines().any(|found| found.starts_with(line)), "{line}: {printed}");
        }
    }
}

#[test]
fn the_printed_settings_are_a_valid_settings_file() {
    let printed = verne("serve --queue 3 --data /somewhere --print-config").unwrap();
    let (_place, path) = file(&printed);
    let again = verne(&format!("serve --config {} --print-config", path.display())).unwrap();
    let values = |text: &str| {
        let lines = text.lines().filter(|line| !line.starts_with('#'));
        lines.map(|line| line.split(" # ").next().unwrap().to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(values(&printed), values(&again));
}

#[test]
fn invalid_settings_are_refused_at_the_start() {
    for (setting, expected) in [
        ("queue = 0", "queue: invalid value '0'"),
        ("queue = 'many'", "queue: invalid value 'many'"),
        ("max_rows = 0", "max_rows: invalid value '0'"),
        ("max_rows = 1000001", "max_rows: invalid value '1000001'"),
        ("max_body_bytes = 0", "max_body_bytes: invalid value '0'"),
        ("cache_bytes = 0", "cache_bytes: invalid value '0'"),
        ("disk_bytes = -1", "disk_bytes: invalid value '-1'"),
        ("timeout = 0", "timeout: invalid value '0'"),
        ("job_limit = 0", "job_limit: invalid value '0'"),
        ("job_threads = 0", "job_threads: invalid value '0'"),
        ("drain = 99999999999", "drain: invalid value '99999999999'"),
        ("max_connections = 0", "max_connections: invalid value '0'"),
        ("max_triangles = 0", "max_triangles: invalid value '0'"),
        ("header_timeout = 0", "header_timeout: invalid value '0'"),
        ("tls_key = 'key.pem'", "tls_key needs tls_certificate"),
        ("cors_origin = ['*', 'example.org']", "cors_origin: invalid value 'example.org'"),
        ("listen = 'nowhere'", "listen: invalid value 'nowhere'"),
        ("allowed_host = ['verne:8080']", "allowed_host: invalid value 'verne:8080'"),
        ("base_path = 'verne'", "base_path: invalid value 'verne'"),
        ("trusted_proxy = '10.0.0.0/99'", "trusted_proxy: invalid value '10.0.0.0/99'"),
        ("listening = '127.0.0.1:80'", "listening: no setting has this name; did you mean listen?"),
        ("memory_only = true\ndata = '/somewhere'", "data and memory_only exclude each other"),
        ("rate_burst = 5", "rate_burst needs rate"),
        ("rate = 0\nrate_burst = 5", "rate_burst needs rate"),
        ("broker_name = 'mine'", "broker_name needs broker"),
        ("broker_replicas = 3", "broker_replicas needs broker"),
        ("broker_ca = 'ca.pem'\nstore = 'file:///shared'", "broker_ca needs broker"),
    ] {
        let (_place, path) = file(setting);
        let error = verne(&format!("serve --config {} --print-config", path.display())).unwrap_err();
        assert!(error.contains(expected), "{setting}: {error}");
    }
}

#[test]
fn an_overridden_setting_is_not_checked() {
    let (_place, path) = file("rate = 5\nrate_burst = 9");
    let serve = format!("serve --config {} --print-config", path.display());
    assert!(verne(&serve).is_ok());
    assert!(verne(&format!("{serve} --rate 0")).is_ok());
    assert!(verne("worker --broker nats://here --broker-name mine --print-config").is_ok());
    assert!(
        verne("worker --broker-name mine --print-config").unwrap_err().contains("broker_name needs broker")
    );
}

#[tokio::test]
async fn an_unusable_setting_is_named() {
    let shared = TempDir::new().unwrap();
    let with_broker = format!("--broker nats://127.0.0.1:1 --store file://{}", shared.path().display());
    for (flags, expected) in [
        ("--broker foo://me:secret@x:1 --store file:///nowhere".to_owned(), "broker: "),
        ("--broker nats://127.0.0.1:1".to_owned(), "store: "),
        (format!("{with_broker} --broker-name a.b"), "broker_name: \"a.b\""),
        (format!("{with_broker} --broker-ca /nowhere"), "broker_ca: /nowhere: "),
        (format!("{with_broker} --broker-nkey /nowhere"), "broker_nkey: /nowhere: "),
        (format!("{with_broker} --broker-credentials /nowhere"), "broker_credentials: /nowhere: "),
        (
            format!("{with_broker} --broker-certificate /nowhere --broker-key /nowhere"),
            "broker_certificate: /nowhere: ",
        ),
        ("--store gs://bucket".to_owned(), "store: gs://bucket "),
        ("--store s3://".to_owned(), "store: s3:// "),
        ("--data /proc/nowhere".to_owned(), "data: "),
    ] {
        let error = Service::open(&settings(&flags)).await.err().unwrap().to_string();
        assert!(error.starts_with(expected) && !error.contains("secret"), "{flags}: {error}");
    }
}
