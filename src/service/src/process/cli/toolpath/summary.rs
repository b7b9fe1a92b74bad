//! The verdict on a program in words.

use std::io::{self, Write};

use serde::Deserialize;

use crate::process::cli::limit_words::{NamedLimit, rounded};

/// Most failing stretches, most warnings, and most rapids that leave their lines, that the summary names.
const MOST_LISTED: usize = 10;

/// A rapid that stays this close to its line does not leave it, mm.
const ON_THE_LINE: f64 = 0.01;

/// What the summary says, read from a report.
#[derive(Debug, Deserialize)]
pub(super) struct Summary {
    verdict: String,
    failures: Vec<Failure>,
    failure_count: u64,
    rows: u64,
    margins: Vec<Margin>,
    warnings: Vec<Warning>,
    warning_count: u64,
    retracts: u64,
    dwell_mark_count: u64,
    departures: Vec<Departure>,
    departure_count: u64,
}

#[derive(Debug, Deserialize)]
struct Failure {
    lines: [u32; 2],
    #[serde(flatten)]
    limit: NamedLimit,
}

#[derive(Debug, Deserialize)]
struct Margin {
    line: u32,
    #[serde(flatten)]
    limit: NamedLimit,
}

#[derive(Debug, Deserialize)]
struct Warning {
    line: u32,
    word: String,
    detail: String,
    occurrences: u32,
}

/// A rapid in which the joints move straight.
#[derive(Clone, Copy, Debug, Deserialize)]
struct Departure {
    line: u32,
    distance: Option<f64>,
}

impl Summary {
    /// Reads a report.
    pub(super) fn read(report: &[u8]) -> Result<Self, String> {
        serde_json::from_slice(report).map_err(|error| format!("the report cannot be read: {error}"))
    }

    /// Whether the machine can run the program.
    pub(super) fn is_ok(&self) -> bool {
        self.verdict == "ok"
    }

    /// Writes the summary.
    pub(super) fn write(&self, err: &mut impl Write) -> io::Result<()> {
        self.write_warnings(err)?;
        self.write_departures(err)?;
        if self.retracts > 0 {
            let times =
                if self.retracts == 1 { "once".to_owned() } else { format!("{} times", self.retracts) };
            writeln!(
                err,
                "warning: within a cut the tool leaves the part {times}, so that the table can turn back."
            )?;
        }
        if self.dwell_mark_count > 0 {
            let places = if self.dwell_mark_count == 1 { "place" } else { "places" };
            writeln!(
                err,
                "warning: the tool stands on the part while the table turns, at {} {places}; the report lists them in \
                 dwell_marks.",
                self.dwell_mark_count
            )?;
        }
        self.write_verdict(err)
    }

    fn write_warnings(&self, err: &mut impl Write) -> io::Result<()> {
        for Warning { line, word, detail, .. } in self.warnings.iter().take(MOST_LISTED) {
            let word = if word.is_empty() { String::new() } else { format!(" {word}:") };
            writeln!(err, "warning: line {line}:{word} {detail}")?;
        }
        let listed = self.warnings.iter().take(MOST_LISTED).map(|warning| u64::from(warning.occurrences));
        match self.warning_count.saturating_sub(listed.sum()) {
            0 => {}
            more => writeln!(err, "warning: {more} more lines have warnings; the report lists them.")?,
        }
        Ok(())
    }

    /// The rapids that leave their lines farthest, in the order of the program: the tool may hit something there.
    fn write_departures(&self, err: &mut impl Write) -> io::Result<()> {
        // Without a distance the platform passes a singularity.
        let distance = |departure: &Departure| departure.distance.unwrap_or(f64::INFINITY);
        let mut farthest = self.departures.clone();
        farthest.retain(|departure| distance(departure) >= ON_THE_LINE);
        let harmless = self.departures.len() - farthest.len();
        farthest.sort_by(|a, b| distance(b).total_cmp(&distance(a)));
        farthest.truncate(MOST_LISTED);
        farthest.sort_by_key(|departure| departure.line);
        for Departure { line, distance } in &farthest {
            let far = match distance {
                Some(distance) => format!("by {} mm", rounded(*distance)),
                None => "and the platform passes a singularity".to_owned(),
            };
            writeln!(err, "warning: line {line}: in a rapid the tool leaves its line {far}")?;
        }
        match self.departure_count.saturating_sub((farthest.len() + harmless) as u64) {
            0 => Ok(()),
            more => {
                writeln!(
                    err,
                    "warning: in {more} more rapids the tool leaves its line; the report lists them."
                )
            }
        }
    }

    fn write_verdict(&self, err: &mut impl Write) -> io::Result<()> {
        if self.is_ok() {
            writeln!(err, "The machine can run the program: {} rows.", self.rows)?;
            let least = |margin: &&Margin| ["mm", "deg"].contains(&margin.limit.unit.as_str());
            for Margin { line, limit } in self.margins.iter().filter(least) {
                let NamedLimit { constraint, element, margin, unit } = limit;
                let (name, margin) = (constraint.replace('_', " "), rounded(*margin));
                writeln!(err, "  least margin of {name}: {margin} {unit} ({element}, line {line})")?;
            }
            return Ok(());
        }
        writeln!(err, "The machine cannot run the program:")?;
        for Failure { lines: [first, last], limit } in self.failures.iter().take(MOST_LISTED) {
            let lines =
                if first == last { format!("line {first}") } else { format!("lines {first} to {last}") };
            writeln!(err, "  {lines}: {}", limit.in_words())?;
        }
        let shown = self.failures.len().min(MOST_LISTED) as u64;
        match self.failure_count.saturating_sub(shown) {
            0 => Ok(()),
            more => writeln!(err, "  and {more} more stretches; the report lists them."),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use serde_json::json;

    use super::Summary;

    #[test]
    fn rapids_that_leave_their_lines_and_retracts_are_named() {
        let mut departures = vec![
            json!({"line": 75, "distance": 62.84, "direction": [0, 0, 1]}),
            json!({"line": 80, "distance": null, "direction": null}),
            json!({"line": 90, "distance": 1e-7, "direction": [0, 0, 1]}),
        ];
        departures.extend((0..10).map(|i| json!({"line": 100 + i, "distance": 10 - i})));
        let report = json!({
            "verdict": "ok", "failures": [], "failure_count": 0, "rows": 9, "margins": [], "warnings": [],
            "warning_count": 0, "retracts": 2, "dwell_mark_count": 3, "departures": departures, "departure_count": 13
        });
        let mut text = Vec::new();
        Summary::read(report.to_string().as_bytes()).unwrap().write(&mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(lines[0], "warning: line 75: in a rapid the tool leaves its line by 62.8 mm");
        let singular =
            "warning: line 80: in a rapid the tool leaves its line and the platform passes a singularity";
        assert_eq!((lines[1], lines.len()), (singular, 14));
        assert_eq!(lines[10], "warning: in 2 more rapids the tool leaves its line; the report lists them.");
        assert!(lines[11].contains("leaves the part 2 times"), "{text}");
        assert!(lines[12].contains("while the table turns, at 3 places"), "{text}");
        assert_eq!(lines[13], "The machine can run the program: 9 rows.");
    }
}
