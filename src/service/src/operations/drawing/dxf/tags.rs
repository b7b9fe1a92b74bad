//! A DXF file's text: lines in pairs, a group's code and its value.

use std::fmt::{Display, Write};

/// Pairs.
#[derive(Default)]
pub(crate) struct Tags(String);

impl Tags {
    pub(crate) fn put(&mut self, code: u16, value: impl Display) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.0, "{code}\n{value}");
    }

    pub(crate) fn number(&mut self, code: u16, number: f64) {
        self.put(code, format_args!("{number:.6}"));
    }

    pub(crate) fn section(&mut self, name: &str) {
        self.put(0, "SECTION");
        self.put(2, name);
    }

    pub(crate) fn append(&mut self, body: &Body) {
        self.0.push_str(&body.tags.0);
    }

    pub(crate) fn into_text(self) -> String {
        self.0
    }
}

/// What follows the header: each object in it has a handle of its own.
#[derive(Default)]
pub(crate) struct Body {
    tags: Tags,
    /// How many handles are taken. 0 is none.
    handles: u32,
}

impl Body {
    pub(crate) fn put(&mut self, code: u16, value: impl Display) {
        self.tags.put(code, value);
    }

    pub(crate) fn number(&mut self, code: u16, number: f64) {
        self.tags.number(code, number);
    }

    pub(crate) fn section(&mut self, name: &str) {
        self.tags.section(name);
    }

    /// Begins an object that another one owns; its handle.
    pub(crate) fn object(&mut self, kind: &str, owner: u32) -> u32 {
        self.object_with(5, kind, owner)
    }

    /// The same, with the code that the kind has for its handle.
    pub(crate) fn object_with(&mut self, code: u16, kind: &str, owner: u32) -> u32 {
        self.put(0, kind);
        self.handle(code, owner)
    }

    /// Gives the object that has just begun its handle and its owner.
    pub(crate) fn handle(&mut self, code: u16, owner: u32) -> u32 {
        let handle = self.next_handle();
        self.handles = handle;
        self.put(code, format_args!("{handle:X}"));
        self.put(330, format_args!("{owner:X}"));
        handle
    }

    /// The first handle that is free.
    pub(crate) fn next_handle(&self) -> u32 {
        self.handles + 1
    }
}
