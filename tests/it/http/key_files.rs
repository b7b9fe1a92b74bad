//! Unusable key files: the error names place and reason.

use verne_service::Service;

use super::config;
use super::keys::{Keys, fresh};

async fn refusal(text: &str) -> String {
    let keys = Keys::new([("cam", "read")]);
    keys.write(text);
    let refusal = Service::open(&keys.asked_for_by(config(None))).await.err().unwrap().to_string();
    let file = keys.file();
    let rest = refusal.strip_prefix("keys: ").and_then(|rest| rest.strip_prefix(file.to_str().unwrap()));
    let rest = rest.unwrap_or_else(|| panic!("{refusal}"));
    rest.strip_prefix(": ").unwrap().to_owned()
}

#[tokio::test]
async fn an_invalid_key_file_names_the_error() {
    let (_, good) = fresh("cam", "read");
    let (key, second) = fresh("cut", "compute");
    let hash = second.lines().find(|line| line.starts_with("hash")).unwrap();
    for (text, place) in [
        (String::new(), "has no entry [[key]]"),
        ("\n\n[[key]".to_owned(), "line 3: "),
        (format!("{good}\n[[keys]]\nname = \"cut\""), "line 6: unknown field `keys`"),
        (second.replace("compute", "write"), "key 1 (cut): role: unknown variant `write`"),
        (format!("{good}\n{}", second.replace("cut", "10.0.0.1")), "key 2: name: must be"),
        (format!("{good}\n{}", second.replace(hash, "")), "key 2 (cut): missing field `hash`"),
        (second.replace(hash, &format!("hash = \"{key}\"")), "key 1 (cut): hash: must be the 64 hexa"),
        (format!("{second}rate = -1"), "key 1 (cut): rate: "),
        (format!("{second}rate_burst = 5"), "key 1 (cut): rate_burst: needs a rate"),
        (format!("{second}rate = 5\nrate_burst = 0"), "key 1 (cut): rate_burst: "),
        (format!("{second}extra = 1"), "key 1 (cut): extra: unknown field `extra`"),
        (format!("{second}\n{second}"), "key 2 (cut): its hash is that of an earlier entry"),
    ] {
        let refusal = refusal(&text).await;
        assert!(refusal.starts_with(place), "{text}\n{refusal}");
        assert!(!refusal.contains(&key[10..]), "a key in the wrong place is not repeated: {refusal}");
    }
}

#[tokio::test]
async fn a_missing_key_file_is_named() {
    let keys = Keys::new([("cam", "read")]);
    std::fs::remove_file(keys.file()).unwrap();
    let refusal = Service::open(&keys.asked_for_by(config(None))).await.err().unwrap().to_string();
    assert!(refusal.contains(keys.file().to_str().unwrap()), "{refusal}");
}
