//! Summarises a program: `cargo run -p verne-program --example summary part.cls`, or with options as JSON:
//! `cargo run -p verne-program --example summary part.ngc '{"tcp_on": ["M428"], "tcp_off": ["M429"]}'`.

use std::fs::File;
use std::io::BufReader;

use verne_program::{Format, MoveKind, ReadError, ReadOptions, read};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("the path of a program is missing")?;
    let options: ReadOptions =
        arguments.next().map(|text| serde_json::from_str(&text)).transpose()?.unwrap_or_default();
    let format = Format::detect(None, Some(&path), None)?;
    match read(format, BufReader::new(File::open(&path)?), &options) {
        Ok(program) => {
            let rapids = program.moves().iter().filter(|one| one.kind() == MoveKind::Rapid).count();
            let arcs = program.moves().iter().filter(|one| program.arc(one).is_some()).count();
            println!("moves: {} ({rapids} rapids, {arcs} arcs)", program.moves().len());
            println!("events: {}, unit of the file: {}", program.events().len(), program.units());
            if let Some(bounds) = program.bounds() {
                println!("bounds in mm: {:?} to {:?}", bounds.min, bounds.max);
            }
            for tool in program.tools() {
                println!("tool: {:?}, length {:?}, line {}", tool.number, tool.length, tool.line);
            }
            println!("warnings: {}", program.warnings().total);
            for warning in &program.warnings().list {
                let (line, word, count) = (warning.line, &warning.word, warning.occurrences);
                println!("  line {line} {word}: {} ({count} times)", warning.detail);
            }
        }
        Err(ReadError::Source(error)) => return Err(error.into()),
        Err(ReadError::Program(refused)) => {
            for error in &refused.errors {
                println!("{error}");
            }
            println!("{} faults{}", refused.errors.len(), if refused.complete { "" } else { ", stopped" });
        }
    }
    Ok(())
}
