//! A strict reader: each character belongs to a word or to a comment.

use std::collections::BTreeMap;

/// A block with its words by letter, without comments.
pub(crate) type Block = BTreeMap<char, Vec<f64>>;

/// Where a controller is after a G0 or G1 block.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Position {
    pub(crate) rapid: bool,
    pub(crate) words: BTreeMap<char, f64>,
    /// The F word that counts.
    pub(crate) feed: Option<f64>,
    /// Whether the block itself has an F.
    pub(crate) has_feed: bool,
}

/// The blocks of a program.
pub(crate) fn blocks(text: &str) -> Vec<Block> {
    text.lines().map(block).filter(|block| !block.is_empty()).collect()
}

fn block(line: &str) -> Block {
    let mut words = Block::new();
    let mut rest = line;
    while let Some(letter) = rest.chars().next() {
        if letter == ' ' {
            rest = &rest[1..];
        } else if letter == '(' {
            let end = rest.find(')').unwrap();
            assert!(!rest[1..end].contains('('), "{line}");
            rest = &rest[end + 1..];
        } else {
            assert!(letter.is_ascii_uppercase(), "{line}");
            let end = rest[1..].find([' ', '(']).map_or(rest.len(), |end| end + 1);
            let number = &rest[1..end];
            assert!(!(number.starts_with("-0") && number.parse::<f64>().unwrap() == 0.0), "{line}");
            words.entry(letter).or_default().push(number.parse().unwrap());
            rest = &rest[end..];
        }
    }
    words
}

/// Moves a controller through a program.
pub(crate) fn positions(text: &str, letters: &str) -> Vec<Position> {
    let mut now = Position { rapid: true, words: BTreeMap::new(), feed: None, has_feed: false };
    let mut positions = Vec::new();
    for block in blocks(text) {
        for code in block.get(&'G').into_iter().flatten() {
            match *code {
                0.0 => now.rapid = true,
                1.0 => now.rapid = false,
                _ => {}
            }
        }
        now.has_feed = block.contains_key(&'F');
        now.feed = block.get(&'F').map(|feed| feed[0]).or(now.feed);
        let moved: Vec<_> = letters.chars().filter(|letter| block.contains_key(letter)).collect();
        for letter in &moved {
            now.words.insert(*letter, block[letter][0]);
        }
        if !moved.is_empty() {
            positions.push(now.clone());
        }
    }
    positions
}
