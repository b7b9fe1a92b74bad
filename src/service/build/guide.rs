//! Builds the guide from `docs` with mdBook.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

use mdbook_driver::MDBook;

use crate::guide_links::Links;
use crate::guide_reference::Reference;

/// Files of other types in `docs` make the guide and are no part of it, such as the scripts of drawings.
const SERVED: [&str; 6] = ["html", "css", "js", "svg", "png", "json"];

/// Writes the pages of the guide and their files to a directory.
pub(crate) fn build(repository: &Path, out: &Path) -> Result<(), String> {
    let mut book = MDBook::load(repository.join("docs")).map_err(|error| format!("{error:#}"))?;
    book.config.build.build_dir = out.to_path_buf();
    let reference = Reference::read(&repository.join("openapi/openapi.json"))?;
    let links = Links::new(repository, &book);
    let mut failed = None;
    book.book.for_each_chapter_mut(|chapter| match links.chapter(chapter) {
        Ok(content) => chapter.content = reference.written_into(&content),
        Err(error) => failed = Some(error),
    });
    if let Some(error) = failed {
        return Err(error);
    }
    book.build().map_err(|error| format!("{error:#}"))?;
    // mdBook has read its settings from there.
    let _ = fs::remove_dir_all(out.join("theme"));
    let mut scripts = Scripts { out: out.to_path_buf(), names: HashMap::new() };
    for file in files(out)? {
        match file.extension().and_then(|extension| extension.to_str()) {
            Some("html") => scripts.separate(&file)?,
            Some(extension) if SERVED.contains(&extension) => {}
            _ => fs::remove_file(&file).map_err(|error| format!("{}: {error}", file.display()))?,
        }
    }
    Ok(())
}

/// The scripts that mdBook writes into its pages, as files: a Content-Security-Policy without `unsafe-inline` lets them
/// run.
struct Scripts {
    out: PathBuf,
    names: HashMap<String, String>,
}

impl Scripts {
    /// Replaces each script of a page by a file. Equal scripts share one.
    fn separate(&mut self, page: &Path) -> Result<(), String> {
        let text = read(page)?;
        let depth = page.strip_prefix(&self.out).map_or(0, |path| path.components().count() - 1);
        let mut parts = text.split("<script>");
        let mut written = parts.next().unwrap_or_default().to_owned();
        for part in parts {
            let (script, rest) = part.split_once("</script>").ok_or("a script does not end")?;
            let name = format!("inline-{}.js", self.names.len());
            let name = self.names.entry(script.to_owned()).or_insert(name);
            write(&self.out.join(&*name), script)?;
            written.extend(["<script src=\"", &"../".repeat(depth), name, "\"></script>", rest]);
        }
        write(page, &written)
    }
}

/// All files below a directory.
fn files(directory: &Path) -> Result<Vec<PathBuf>, String> {
    let failed = |error| format!("{}: {error}", directory.display());
    let mut found = Vec::new();
    for entry in fs::read_dir(directory).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path.is_dir() {
            found.extend(files(&path)?);
        } else {
            found.push(path);
        }
    }
    Ok(found)
}

pub(crate) fn read(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))
}
