//! Files of the repository as chapters of the guide, and links between them.
//!
//! A paragraph of a chapter that is one link to a Markdown file outside `docs` stands for the text of that file. Links
//! lead to the chapter that contains a file. If the guide does not contain it, only the text of the link stays.

use std::collections::HashMap;
use std::path::{Component, Path, PathBuf};

use mdbook_driver::MDBook;
use mdbook_driver::book::Chapter;
use pulldown_cmark::{BrokenLink, CowStr, Event, Options, Parser, Tag};

use crate::guide::read;

/// The folder of the guide's sources.
const DOCS: &str = "docs";

/// The target of brackets that have none.
const UNDEFINED: &str = "undefined:";

/// The places of files in the guide. All paths are relative to the repository.
pub(crate) struct Links {
    repository: PathBuf,
    /// The chapter that consists of a file outside `docs`.
    chapters: HashMap<PathBuf, PathBuf>,
}

impl Links {
    pub(crate) fn new(repository: &Path, book: &MDBook) -> Self {
        let mut chapters = HashMap::new();
        for chapter in book.book.chapters() {
            let place = place(chapter);
            if let Some(file) = included(&chapter.content, parent(&place)) {
                chapters.insert(file, place);
            }
        }
        Self { repository: repository.to_path_buf(), chapters }
    }

    /// The text of a chapter, with the files for which its links stand.
    pub(crate) fn chapter(&self, chapter: &Chapter) -> Result<String, String> {
        let place = place(chapter);
        let mut written = String::new();
        for paragraph in chapter.content.split_inclusive("\n\n") {
            if let Some(file) = included(paragraph, parent(&place)) {
                let text = read(&self.repository.join(&file))?;
                written += &self.rewritten(&text, parent(&file), &place);
                written += "\n";
            } else {
                written += paragraph;
            }
        }
        // The files have been rewritten already: their links lead to chapters, so nothing changes.
        Ok(self.rewritten(&written, parent(&place), &place))
    }

    /// The text with links that lead from a chapter to where the guide has their files.
    fn rewritten(&self, text: &str, folder: &Path, chapter: &Path) -> String {
        let undefined = |_: BrokenLink<'_>| Some((CowStr::from(UNDEFINED), CowStr::from("")));
        let mut rest = text.len();
        let mut changed = Vec::new();
        let options = Options::ENABLE_TABLES;
        for (event, range) in
            Parser::new_with_broken_link_callback(text, options, Some(undefined)).into_offset_iter()
        {
            let Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) = event else {
                continue;
            };
            if let Some(link) = self.link(&text[range.clone()], &dest_url, folder, chapter) {
                changed.push((range, link));
            }
        }
        let mut parts = Vec::new();
        for (range, link) in changed.into_iter().rev() {
            parts.push(text[range.end..rest].to_owned());
            parts.push(link);
            rest = range.start;
        }
        parts.push(text[..rest].to_owned());
        parts.reverse();
        parts.concat()
    }

    /// What stands for a link, unless it stays as it is.
    fn link(&self, source: &str, target: &str, folder: &Path, chapter: &Path) -> Option<String> {
        if target.starts_with('#') || target.contains("://") || source.starts_with('<') {
            return None;
        }
        let label = source.find("](").map_or_else(|| source.trim_matches(['[', ']']), |end| &source[1..end]);
        // Brackets that are no link are mathematics; around code they are a link of rustdoc.
        if target == UNDEFINED && !label.starts_with('`') {
            return None;
        }
        let (path, anchor) = target.split_once('#').unwrap_or((target, ""));
        let file = normal(&folder.join(path));
        let place = self.chapters.get(&file).unwrap_or(&file);
        if !place.starts_with(DOCS) || target.contains("::") || target == UNDEFINED {
            return Some(label.to_owned());
        }
        let up = "../".repeat(parent(chapter).components().count() - 1);
        let below = place.strip_prefix(DOCS).unwrap_or(place).display();
        let image = if source.starts_with('!') { "!" } else { "" };
        let label = label.trim_start_matches('[');
        let anchor = if anchor.is_empty() { String::new() } else { format!("#{anchor}") };
        Some(format!("{image}[{label}]({up}{below}{anchor})"))
    }
}

/// The source of a chapter.
fn place(chapter: &Chapter) -> PathBuf {
    Path::new(DOCS).join(chapter.source_path.as_deref().unwrap_or(Path::new("")))
}

/// The file outside `docs` for which a paragraph stands.
fn included(paragraph: &str, folder: &Path) -> Option<PathBuf> {
    let link = paragraph.trim().strip_prefix('[')?.strip_suffix(')')?;
    let (_, target) = link.split_once("](")?;
    let file = normal(&folder.join(target));
    let is_markdown = file.extension().is_some_and(|extension| extension == "md");
    let whole = !target.contains([' ', '(', ')']) && is_markdown && !file.starts_with(DOCS);
    whole.then_some(file)
}

fn parent(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

/// The path without `..`.
fn normal(path: &Path) -> PathBuf {
    let mut parts = Vec::new();
    for part in path.components() {
        match part {
            Component::ParentDir => drop(parts.pop()),
            Component::CurDir => {}
            part => parts.push(part),
        }
    }
    parts.iter().collect()
}
