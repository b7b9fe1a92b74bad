//! Files that stand in `tests/golden`.

use std::path::Path;

/// Asserts that the file has these bytes; with `VERNE_BLESS=1`, writes it.
pub(crate) fn assert_equal(name: &str, extension: &str, bytes: &[u8]) {
    let file =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(name).with_extension(extension);
    if std::env::var_os("VERNE_BLESS").is_some() {
        std::fs::write(&file, bytes).unwrap();
    }
    assert!(std::fs::read(&file).unwrap() == bytes, "{} differs from the bytes written now", file.display());
}
