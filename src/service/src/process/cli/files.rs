//! The files that commands read and write; `-` is standard input or output.

use std::fs::{self, File};
use std::io::{self, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

/// Whether a path means standard input or output.
pub(crate) fn is_standard(path: &Path) -> bool {
    path == Path::new("-")
}

/// An input as messages name it.
pub(crate) fn name_of(path: &Path) -> String {
    if is_standard(path) { "standard input".to_owned() } else { path.display().to_string() }
}

/// A file, or standard input for `-`.
pub(crate) fn source(path: &Path) -> Result<Box<dyn Read>, String> {
    if is_standard(path) {
        return Ok(Box::new(io::stdin().lock()));
    }
    let file = File::open(path).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(Box::new(file))
}

/// A file, or standard output for `-`.
pub(crate) fn destination<'a>(path: &Path, out: &'a mut dyn Write) -> Result<Box<dyn Write + 'a>, String> {
    if is_standard(path) {
        return Ok(Box::new(out));
    }
    let file = File::create(path).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(Box::new(BufWriter::new(file)))
}

/// Removes a file that is not complete, or that nobody should use.
pub(crate) fn remove(path: &Path) {
    if fs::remove_file(path).is_err() {
        // Nobody should use what is left of it.
        drop(File::create(path));
    }
}

/// A file with the name that messages give it; `None` if the command has no such file.
pub(crate) type NamedFile<'a> = (&'a str, Option<&'a Path>);

/// Refuses to write over a file that the command reads, or one output over the other.
pub(crate) fn refuse_equal_files(read: &[NamedFile<'_>], written: &[NamedFile<'_>]) -> Result<(), String> {
    let given =
        |(name, path): &NamedFile<'_>, standard| Some(((*name).to_owned(), file((*path)?, standard)?));
    let mut others: Vec<_> = read.iter().filter_map(|named| given(named, "/dev/stdin")).collect();
    for (flag, path) in written.iter().filter_map(|named| given(named, "/dev/stdout")) {
        if let Some((other, _)) = others.iter().find(|(_, other)| *other == path) {
            return Err(format!("{flag} {} would overwrite {other}; name another file", path.display()));
        }
        others.push((flag, path));
    }
    Ok(())
}

/// The file that a path names. One that does not exist yet counts as the one that would be created. `standard` is the
/// file of `-`, into which a shell may have redirected it; a pipe or a terminal is none.
fn file(path: &Path, standard: &str) -> Option<PathBuf> {
    if is_standard(path) {
        return Path::new(standard).canonicalize().ok().filter(|path| path.is_file());
    }
    let existing = path.canonicalize();
    let created = || {
        let directory = path.parent().filter(|directory| !directory.as_os_str().is_empty());
        Some(directory.unwrap_or(Path::new(".")).canonicalize().ok()?.join(path.file_name()?))
    };
    existing.ok().or_else(created)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use std::fs;

    use super::{file, refuse_equal_files};

    #[test]
    fn a_file_has_many_paths_whether_it_exists_or_not() {
        let directory = tempfile::tempdir().unwrap();
        let path = |name: &str| directory.path().join(name);
        fs::create_dir(path("inside")).unwrap();
        fs::write(path("part.csv"), "").unwrap();
        let same = |first: &str, second: &str| {
            file(&path(first), "-").is_some_and(|first| Some(first) == file(&path(second), "-"))
        };
        for (first, second, expected) in [
            ("part.csv", "part.csv", true),
            ("part.csv", "inside/../part.csv", true),
            ("new.csv", "inside/../new.csv", true),
            ("part.csv", "inside/part.csv", false),
            ("part.csv", "new.csv", false),
            ("part.csv", "missing/part.csv", false),
        ] {
            assert_eq!(same(first, second), expected, "{first} {second}");
        }
        assert_eq!(file("new.csv".as_ref(), "-"), file("./new.csv".as_ref(), "-"));
    }

    #[test]
    fn standard_input_may_be_a_file() {
        let directory = tempfile::tempdir().unwrap();
        let redirected = directory.path().join("part.csv");
        fs::write(&redirected, "").unwrap();
        let standard = redirected.to_str().unwrap();
        assert_eq!(file("-".as_ref(), standard), file(&redirected, "-"));
        assert_eq!(file("-".as_ref(), "/dev/null"), None);
        assert_eq!(file("-".as_ref(), directory.path().join("pipe").to_str().unwrap()), None);
    }

    #[test]
    fn no_output_is_an_input_or_another_output() {
        let read = [("the rows", Some("new.csv".as_ref())), ("the machine", None)];
        let refused = |written: &[_]| refuse_equal_files(&read, written).unwrap_err();
        assert!(
            refused(&[("--output", Some("./new.csv".as_ref()))]).contains("new.csv would overwrite the rows")
        );
        let twice = [("--output", Some("x.csv".as_ref())), ("--report", Some("./x.csv".as_ref()))];
        assert!(refused(&twice).contains("x.csv would overwrite --output"));
        assert_eq!(refuse_equal_files(&read, &[("--output", Some("y.csv".as_ref()))]), Ok(()));
    }
}
