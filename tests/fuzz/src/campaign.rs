//! A campaign: runs a target on its corpus, and on random mutations of it.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};

use crate::Target;

/// Greatest length of an input, bytes.
const LONGEST: usize = 4096;

/// Greatest time of one input in a long campaign.
const HANG: Duration = Duration::from_secs(1);

/// Runs a target on its corpus, and on as many mutations as the environment or the target states.
pub fn run(target: &Target) {
    let corpus = corpus(target.name);
    assert!(!corpus.is_empty(), "no corpus of {}", target.name);
    let begun = Instant::now();
    for input in &corpus {
        attempt(target, input);
    }
    let number_of = |name| std::env::var(name).ok().map(|text| text.parse::<u32>().unwrap());
    let long = number_of("VERNE_FUZZ");
    let mut random =
        Xoshiro256PlusPlus::seed_from_u64(number_of("VERNE_FUZZ_SEED").unwrap_or_default().into());
    let count = long.unwrap_or(target.default_inputs);
    for _ in 0..count {
        let input = mutated(&mut random, &corpus);
        let started = Instant::now();
        attempt(target, &input);
        // A slow input must be slow twice: the first time the computer may have been busy.
        if long.is_some() && started.elapsed() > HANG {
            let again = Instant::now();
            attempt(target, &input);
            assert!(again.elapsed() <= HANG, "{} takes {:?} for {input:?}", target.name, again.elapsed());
        }
    }
    println!("{}: {} inputs in {:?}", target.name, corpus.len() + count as usize, begun.elapsed());
}

/// Runs one input; if the target panics, prints the input.
fn attempt(target: &Target, input: &[u8]) {
    struct PrintOnPanic<'a>(&'a [u8]);
    impl Drop for PrintOnPanic<'_> {
        fn drop(&mut self) {
            if std::thread::panicking() {
                eprintln!("the input: b\"{}\"", self.0.escape_ascii());
            }
        }
    }
    let print = PrintOnPanic(input);
    (target.run)(input);
    drop(print);
}

/// The inputs of a target's directory.
fn corpus(name: &str) -> Vec<Vec<u8>> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(name);
    let mut files: Vec<_> = fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files.into_iter().map(|file| fs::read(file).unwrap()).collect()
}

/// One in four: random bytes. The others: a mutation of an input of the corpus.
fn mutated(random: &mut Xoshiro256PlusPlus, corpus: &[Vec<u8>]) -> Vec<u8> {
    if random.random_ratio(1, 4) {
        let length = random.random_range(0..256);
        return (0..length).map(|_| random.random()).collect();
    }
    let mut input = corpus[random.random_range(0..corpus.len())].clone();
    for _ in 0..random.random_range(1..8) {
        let (from, to) = range(random, input.len());
        match random.random_range(0..6) {
            0 => input[from..to].iter_mut().for_each(|byte| *byte = random.random()),
            1 if from < input.len() => input[from] ^= 1 << random.random_range(0..8),
            2 => drop(input.drain(from..to)),
            3 => {
                let copy = input[from..to].to_vec();
                let (at, _) = range(random, input.len());
                input.splice(at..at, copy);
            }
            4 => {
                let other = &corpus[random.random_range(0..corpus.len())];
                let (start, end) = range(random, other.len());
                input.splice(from..to, other[start..end].iter().copied());
            }
            _ => input.insert(from, random.random()),
        }
    }
    input.truncate(LONGEST);
    input
}

/// A range of at most `length` bytes, usually a short one.
fn range(random: &mut Xoshiro256PlusPlus, length: usize) -> (usize, usize) {
    let from = random.random_range(0..=length);
    let most = if random.random_ratio(1, 4) { length } else { length.min(from + 8) };
    (from, random.random_range(from..=most.max(from)))
}
