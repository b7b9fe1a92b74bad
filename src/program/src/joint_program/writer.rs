//! The writer.

use std::fmt::Write as _;
use std::io::Write;
use std::iter::Peekable;

use super::error::JointProgramError;
use super::event_lines::{EventLine, event_line};
use super::numbers::{Fixed, significant};
use super::options::{FeedWord, JointProgramOptions, LARGEST_NUMBER, RapidWord};
use super::text::comment;
use super::words::{legend, words};
use super::{JointProgramSummary, JointRow};
use crate::event::{Event, EventKind, Spindle};

/// Ways of the tip below this length are none, mm.
const STANDSTILL: f64 = 1e-6;

/// Writes a joint program row by row; it holds one line.
///
/// ```
/// use verne_program::joint_program::{JointProgramOptions, JointProgramWriter, JointRow};
/// use verne_program::{Format, ReadOptions, read};
///
/// let text = "UNITS/MM\nRAPID\nGOTO/0,0,320\nCOOLNT/ON\nFEDRAT/1200,MMPM\nGOTO/0,0,300\nFINI\n";
/// let program = read(Format::Apt, text.as_bytes(), &ReadOptions::default())?;
/// let row = |step, rapid, rho, duration| {
///     let joints = [rho, rho, rho, 0.0, 0.5_f64.to_radians()];
///     JointRow { step, line: 3, rapid, joints, tip: [0.0, 0.0, -rho], duration }
/// };
///
/// let options = JointProgramOptions::default();
/// let mut writer = JointProgramWriter::new(Vec::new(), options, program.events().to_vec())?;
/// writer.row(&row(0, true, 600.0, None))?;
/// writer.row(&row(1, false, 620.0, Some(1.0)))?;
/// let (out, _) = writer.finish()?;
///
/// let lines: Vec<_> = out.split(|byte| *byte == b'\n').map(String::from_utf8_lossy).collect();
/// assert_eq!(lines[3..6], ["G21 G90 G40 G49 G80 G93", "G0 X600.0 Y600.0 Z600.0 A0.0 C0.5", "M8"]);
/// assert_eq!(lines[6..8], ["G1 X620.0 Y620.0 Z620.0 A0.0 C0.5 F60.0", "M30"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct JointProgramWriter<W> {
    out: W,
    options: JointProgramOptions,
    /// The events that were not written yet.
    events: Peekable<std::vec::IntoIter<Event>>,
    /// The row of the last block.
    last: Option<JointRow>,
    /// Where the axes stand; unknown after an insert.
    position: Option<[Fixed; 5]>,
    /// The words that the controller remembers; none after an event.
    modal: Modal,
    /// Time of the rows without a block since the last block, s.
    carried: f64,
    number: u32,
    source_line: u32,
    speed: Option<f64>,
    summary: JointProgramSummary,
    /// The source line of the first block whose F is limited.
    first_limited: Option<u32>,
    text: String,
}

/// Words that the controller remembers.
#[derive(Debug, Default)]
struct Modal {
    words: Option<[Fixed; 5]>,
    code: &'static str,
    feed: String,
}

impl<W: Write> JointProgramWriter<W> {
    /// Writes the head. The events are those of the program, in its order.
    ///
    /// # Errors
    ///
    /// [`JointProgramError::Options`], or the error of `out`.
    pub fn new(out: W, options: JointProgramOptions, events: Vec<Event>) -> Result<Self, JointProgramError> {
        options.check()?;
        let mut writer = Self {
            out,
            options,
            events: events.into_iter().peekable(),
            last: None,
            position: None,
            modal: Modal::default(),
            carried: 0.0,
            number: 0,
            source_line: 0,
            speed: None,
            summary: JointProgramSummary::default(),
            first_limited: None,
            text: String::new(),
        };
        writer.head()?;
        Ok(writer)
    }

    /// Writes the events before the row's move, then the row's block.
    ///
    /// # Errors
    ///
    /// - [`JointProgramError::NoDuration`]: a feed row has no duration.
    /// - [`JointProgramError::OutOfRange`]: a word has too many digits.
    /// - [`JointProgramError::Write`]: the error of `out`.
    pub fn row(&mut self, row: &JointRow) -> Result<(), JointProgramError> {
        self.events_before(row.step)?;
        let words = words(&self.options, row)?;
        let is_g0 = row.rapid && (self.options.rapids == RapidWord::G0 || row.duration.is_none());
        if self.position == Some(words) {
            self.carried += row.duration.filter(|_| !is_g0).unwrap_or(0.0);
            self.summary.merged += 1;
            return Ok(());
        }
        let feed = if is_g0 { None } else { Some(self.feed_word(row)?) };
        self.block(row, words, feed)?;
        (self.last, self.position, self.carried) = (Some(*row), Some(words), 0.0);
        Ok(())
    }

    /// Where the program is written to.
    pub fn out(&mut self) -> &mut W {
        &mut self.out
    }

    /// Writes the events that are left, and the foot. Returns the destination, and what was written.
    ///
    /// # Errors
    ///
    /// [`JointProgramError::Write`]: the error of `out`.
    pub fn finish(mut self) -> Result<(W, JointProgramSummary), JointProgramError> {
        self.events_before(usize::MAX)?;
        if let Some(line) = self.first_limited {
            let [limit, count] = [significant(self.options.greatest_feed), self.summary.limited.to_string()];
            let text = format!(
                "blocks that need more than F{limit} and take longer than planned: {count}, the first of line {line}"
            );
            writeln!(self.out, "{}", comment(&text))?;
        }
        for line in &self.options.foot {
            writeln!(self.out, "{line}")?;
        }
        self.out.flush()?;
        Ok((self.out, self.summary))
    }

    fn head(&mut self) -> Result<(), JointProgramError> {
        for line in &self.options.head {
            writeln!(self.out, "{line}")?;
        }
        for text in &self.options.comments {
            writeln!(self.out, "{}", comment(text))?;
        }
        writeln!(self.out, "{}", comment(&legend(&self.options)))?;
        let [length, angle] = [self.options.length_decimals, self.options.angle_decimals]
            .map(|decimals| format!("{:.*}", usize::from(decimals) + 1, 0.5 / 10_f64.powi(decimals.into())));
        let rounding = format!("words differ from joints by at most {length} mm and {angle} degrees");
        writeln!(self.out, "{}", comment(&rounding))?;
        let limit = significant(self.options.greatest_feed);
        let limit = format!("F is at most {limit}; if a block needs more, a comment at the end says so");
        writeln!(self.out, "{}", comment(&limit))?;
        let feed = match self.options.feed {
            FeedWord::InverseTime => "G93",
            FeedWord::PerMinute => "G94",
        };
        self.code(&format!("G21 G90 G40 G49 G80 {feed}"))
    }

    fn events_before(&mut self, step: usize) -> Result<(), JointProgramError> {
        while let Some(event) = self.events.next_if(|event| event.before as usize <= step) {
            self.event(&event)?;
        }
        Ok(())
    }

    fn event(&mut self, event: &Event) -> Result<(), JointProgramError> {
        if let EventKind::Spindle(Spindle { speed: Some(speed), .. }) = event.kind {
            self.speed = Some(speed);
        }
        self.modal = Modal::default();
        match event_line(event, self.speed) {
            Some(EventLine::Code(words)) => self.code(&words),
            Some(EventLine::Insert(line)) => {
                self.position = None;
                Ok(writeln!(self.out, "{line}")?)
            }
            Some(EventLine::Comment(line)) => Ok(writeln!(self.out, "{line}")?),
            None => Ok(()),
        }
    }

    /// The F word of a row, from its duration and that of the rows without a block before it.
    fn feed_word(&mut self, row: &JointRow) -> Result<String, JointProgramError> {
        let duration = row.duration.ok_or(JointProgramError::NoDuration { line: row.line })?;
        let minutes = (duration + self.carried) / 60.0;
        let way = match self.options.feed {
            FeedWord::InverseTime => 1.0,
            FeedWord::PerMinute => self.last.map_or(0.0, |last| way(&last, row)),
        };
        let feed = way / minutes;
        let greatest = self.options.greatest_feed;
        if feed > greatest {
            self.summary.limited += 1;
            self.first_limited.get_or_insert(row.line);
        }
        // A row without a way beside the rounding of its words is as fast as any may be.
        Ok(significant(if feed > 0.0 { feed.min(greatest) } else { greatest }))
    }

    fn block(
        &mut self,
        row: &JointRow,
        words: [Fixed; 5],
        feed: Option<String>,
    ) -> Result<(), JointProgramError> {
        self.text.clear();
        let code = if feed.is_some() { "G1" } else { "G0" };
        if self.modal.code != code {
            self.text.push_str(code);
            self.modal.code = code;
        }
        for (index, (axis, word)) in self.options.axes.iter().zip(words).enumerate() {
            if self.modal.words.is_none_or(|last| last[index] != word) {
                let separator = if self.text.is_empty() { "" } else { " " };
                self.text.push_str(separator);
                self.text.push(axis.letter);
                word.append_to(&mut self.text);
            }
        }
        self.modal.words = Some(words);
        if let Some(feed) = feed
            && (self.options.feed == FeedWord::InverseTime || self.modal.feed != feed)
        {
            let _ = write!(self.text, " F{feed}");
            self.modal.feed = feed;
        }
        if self.options.source_lines && self.source_line != row.line {
            let _ = write!(self.text, " (line {})", row.line);
            self.source_line = row.line;
        }
        self.summary.blocks += 1;
        let text = std::mem::take(&mut self.text);
        self.code(&text)?;
        self.text = text;
        Ok(())
    }

    /// Writes words, after the block's number if blocks have numbers.
    fn code(&mut self, words: &str) -> Result<(), JointProgramError> {
        if let Some(step) = self.options.numbers {
            let next = self.number + step;
            self.number = if next > LARGEST_NUMBER { step } else { next };
            write!(self.out, "N{} ", self.number)?;
        }
        Ok(writeln!(self.out, "{words}")?)
    }
}

/// The way of the tip in mm. Where it stands still, that of the table in degrees, and at last that of the sliders.
fn way(from: &JointRow, to: &JointRow) -> f64 {
    let distance = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (b - a).powi(2)).sum::<f64>().sqrt();
    let tip = distance(&from.tip, &to.tip);
    let table = distance(&from.joints[3..], &to.joints[3..]).to_degrees();
    let sliders = distance(&from.joints[..3], &to.joints[..3]);
    [tip, table, sliders].into_iter().find(|way| *way >= STANDSTILL).unwrap_or(0.0)
}
