//! A campaign: the corpus of a target, and what random changes make of it.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};

use crate::Target;

/// The longest input.
const LONGEST: usize = 4096;

/// What an input may take in a long campaign.
const HANG: Duration = Duration::from_secs(1);

/// Gives a target its corpus and what the environment says or few inputs more.
pub fn run(target: &Target) {
    let corpus = corpus(target.name);
    assert!(!corpus.is_empty(), "no corpus of {}", target.name);
    let begun = Instant::now();
    for input in &corpus {
        attempt(target, input);
    }
    let asked = |name| std::env::var(name).ok().map(|text| text.parse::<u32>().unwrap());
    let long = asked("VERNE_FUZZ");
    let mut random = Xoshiro256PlusPlus::seed_from_u64(asked("VERNE_FUZZ_SEED").unwrap_or_default().into());
    let count = long.unwrap_or(target.few);
    for _ in 0..count {
        let input = changed(&mut random, &corpus);
        let started = Instant::now();
        attempt(target, &input);
        // A machine that does something else for a while does so once: an input that is slow is so again.
        if long.is_some() && started.elapsed() > HANG {
            let again = Instant::now();
            attempt(target, &input);
            assert!(again.elapsed() <= HANG, "{} takes {:?} for {input:?}", target.name, again.elapsed());
        }
    }
    println!("{}: {} inputs in {:?}", target.name, corpus.len() + count as usize, begun.elapsed());
}

/// Runs one input; where it panics, says which it was.
fn attempt(target: &Target, input: &[u8]) {
    struct Told<'a>(&'a [u8]);
    impl Drop for Told<'_> {
        fn drop(&mut self) {
            if std::thread::panicking() {
                eprintln!("the input: b\"{}\"", self.0.escape_ascii());
            }
        }
    }
    let told = Told(input);
    (target.run)(input);
    drop(told);
}

/// The inputs of a target's directory.
fn corpus(name: &str) -> Vec<Vec<u8>> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(name);
    let mut files: Vec<_> = fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files.into_iter().map(|file| fs::read(file).unwrap()).collect()
}

/// One in four: random bytes. The others: an input of the corpus with some changes.
fn changed(random: &mut Xoshiro256PlusPlus, corpus: &[Vec<u8>]) -> Vec<u8> {
    if random.random_ratio(1, 4) {
        let length = random.random_range(0..256);
        return (0..length).map(|_| random.random()).collect();
    }
    let mut input = corpus[random.random_range(0..corpus.len())].clone();
    for _ in 0..random.random_range(1..8) {
        let (from, to) = place(random, input.len());
        match random.random_range(0..6) {
            0 => input[from..to].iter_mut().for_each(|byte| *byte = random.random()),
            1 if from < input.len() => input[from] ^= 1 << random.random_range(0..8),
            2 => drop(input.drain(from..to)),
            3 => {
                let copy = input[from..to].to_vec();
                let (at, _) = place(random, input.len());
                input.splice(at..at, copy);
            }
            4 => {
                let other = &corpus[random.random_range(0..corpus.len())];
                let (start, end) = place(random, other.len());
                input.splice(from..to, other[start..end].iter().copied());
            }
            _ => input.insert(from, random.random()),
        }
    }
    input.truncate(LONGEST);
    input
}

/// A range of so many bytes, short as a rule.
fn place(random: &mut Xoshiro256PlusPlus, length: usize) -> (usize, usize) {
    let from = random.random_range(0..=length);
    let most = if random.random_ratio(1, 4) { length } else { length.min(from + 8) };
    (from, random.random_range(from..=most.max(from)))
}
