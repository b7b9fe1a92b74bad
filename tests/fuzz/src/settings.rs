//! Arbitrary text as a file of settings.

use std::ffi::OsString;
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

use tempfile::TempDir;
use verne_service::Cli;

use crate::draw::Draw;

static PLACE: LazyLock<TempDir> = LazyLock::new(|| TempDir::new().unwrap());

/// The keys that the service has, from its error for an unknown key.
static KEYS: LazyLock<Vec<String>> = LazyLock::new(|| {
    let path = PLACE.path().join("unknown.toml");
    fs::write(&path, "unknown = 1").unwrap();
    let error = read(&path, "serve").unwrap_err();
    let (_, keys) = error.trim().split_once("the settings are ").unwrap();
    keys.split(", ")
        .map(str::to_owned)
        .chain(["slots", "config", "print_config", "listening", "\"\""].map(str::to_owned))
        .collect()
});

/// The settings in force with a file, or what is wrong with it.
fn read(path: &Path, command: &str) -> Result<String, String> {
    let words = [
        "verne".into(),
        command.into(),
        "--print-config".into(),
        "--config".into(),
        path.as_os_str().to_owned(),
    ];
    let mut out = Vec::new();
    Cli::read(words.map(OsString::from)).map_err(|error| error.to_string())?.run(
        &mut out,
        &mut std::io::sink(),
        None,
    )?;
    Ok(String::from_utf8(out).unwrap())
}

/// Bytes as a file, or settings with any values. What is printed is a file that gives the same.
pub(crate) fn settings(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let command = draw.pick(&["serve", "worker"]);
    let text = if draw.one_in(2) { draw.rest().to_vec() } else { lines(&mut draw).into_bytes() };
    let path = PLACE.path().join(format!("{:?}.toml", std::thread::current().id()));
    fs::write(&path, text).unwrap();
    match read(&path, command) {
        Ok(printed) => {
            fs::write(&path, &printed).unwrap();
            read(&path, command).unwrap_or_else(|error| panic!("{error}\n{printed}"));
        }
        Err(error) => assert!(error.len() > 10, "{error:?}"),
    }
}

fn lines(draw: &mut Draw<'_>) -> String {
    let mut text = String::new();
    for _ in 0..draw.below(6) {
        let key = &KEYS[draw.below(KEYS.len())];
        writeln!(text, "{key} = {}", value(draw)).unwrap();
    }
    text
}

fn value(draw: &mut Draw<'_>) -> String {
    match draw.below(8) {
        0 => format!("{:?}", draw.text()),
        1 => draw.numeral(100.0),
        2 => format!("[{}, {:?}]", draw.numeral(10.0), draw.text()),
        3 => draw
            .pick(&["true", "false", "[]", "{}", "{x = 1}", "1979-05-27", "'''a\nb'''", "0b101", "\"--\""])
            .to_owned(),
        4 => draw
            .pick(&[
                "'127.0.0.1:80'",
                "'[::1]:0'",
                "'nats://a,tls://b'",
                "'s3://a/b'",
                "'file:///a'",
                "'json'",
            ])
            .to_owned(),
        _ => draw
            .pick(&["0", "1", "7", "100", "-1", "99999999999", "9223372036854775807", "1e3", "nan"])
            .to_owned(),
    }
}
