//! The codes of a block, and which of them exclude each other.

use arrayvec::ArrayVec;

use crate::code::{Code, CodeKind};
use crate::error::ProgramError;
use crate::gcode::block::Block;
use crate::gcode::lexer::{MOST_WORDS, Word};
use crate::gcode::vocabulary::{GROUPS, Group, Meaning, Miscellaneous, general, miscellaneous};
use crate::numerals::tenths;
use crate::options::ReadOptions;

/// The codes of a block.
#[derive(Debug, Default)]
pub(crate) struct Codes<'b, 'a> {
    general: [Option<(Meaning, &'b Word<'a>)>; GROUPS],
    /// The M codes in their order.
    pub(crate) miscellaneous: ArrayVec<(Miscellaneous, &'b Word<'a>), MOST_WORDS>,
    /// A code of the request that switches control of the tool centre point.
    pub(crate) switch: Option<(Switch, &'b Word<'a>)>,
}

/// The effect of a code of the request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Switch {
    On,
    Off,
    /// The code is one of `tcp_on` and of `tcp_off`.
    Toggle,
}

impl<'b, 'a> Codes<'b, 'a> {
    /// The codes of a block, or the fault of one.
    pub(crate) fn of(block: &'b Block<'a>, options: &ReadOptions) -> Result<Self, ProgramError> {
        let mut codes = Self::default();
        for word in block.words() {
            match word.letter {
                b'G' => codes.add_general(block, word, options)?,
                b'M' => codes.add_miscellaneous(block, word, options)?,
                _ => {}
            }
        }
        if let (Some((Meaning::Cycle(_), cycle)), Some((_, off))) =
            (codes.general[Group::Motion as usize], codes.general[Group::CycleOff as usize])
        {
            return Err(excluded(block, cycle, off));
        }
        Ok(codes)
    }

    /// The code of a group.
    pub(crate) fn get(&self, group: Group) -> Option<Meaning> {
        self.general[group as usize].map(|(meaning, _)| meaning)
    }

    /// The word of the code of a group.
    pub(crate) fn word(&self, group: Group) -> Option<&'b Word<'a>> {
        self.general[group as usize].map(|(_, word)| word)
    }

    /// A fault at the code of a group.
    pub(crate) fn fault(&self, block: &Block<'_>, group: Group, detail: String) -> ProgramError {
        match self.word(group) {
            Some(word) => block.fault_at(word, detail),
            None => block.fault(detail),
        }
    }

    fn add_general(
        &mut self,
        block: &Block<'_>,
        word: &'b Word<'a>,
        options: &ReadOptions,
    ) -> Result<(), ProgramError> {
        let number = number(block, word)?;
        let switches = self.add_switch(block, word, Code::new(CodeKind::G, number), options)?;
        let meaning = match general(number) {
            Ok(meaning) => meaning,
            Err(_) if switches => return Ok(()),
            Err(detail) => return Err(block.fault_at(word, detail.to_owned())),
        };
        let found = &mut self.general[meaning.group() as usize];
        if let Some((_, first)) = found {
            return Err(excluded(block, first, word));
        }
        *found = Some((meaning, word));
        Ok(())
    }

    fn add_miscellaneous(
        &mut self,
        block: &Block<'_>,
        word: &'b Word<'a>,
        options: &ReadOptions,
    ) -> Result<(), ProgramError> {
        let number = number(block, word)?;
        let switches = self.add_switch(block, word, Code::new(CodeKind::M, number), options)?;
        let meaning = miscellaneous(number);
        if switches && meaning == Miscellaneous::Unknown {
            return Ok(());
        }
        if meaning == Miscellaneous::Call {
            let detail = "calls (M97, M98, M99) are not read; post one program without calls";
            return Err(block.fault_at(word, detail.to_owned()));
        }
        if let Some((_, first)) = self.miscellaneous.iter().find(|(known, _)| known.excludes(meaning)) {
            return Err(excluded(block, first, word));
        }
        let pushed = self.miscellaneous.try_push((meaning, word));
        pushed.map_err(|_| block.fault_at(word, format!("a block has at most {MOST_WORDS} codes")))
    }

    /// Whether the code is one of the request.
    fn add_switch(
        &mut self,
        block: &Block<'_>,
        word: &'b Word<'a>,
        code: Code,
        options: &ReadOptions,
    ) -> Result<bool, ProgramError> {
        let switch = match (options.tcp_on.contains(&code), options.tcp_off.contains(&code)) {
            (true, true) => Switch::Toggle,
            (true, false) => Switch::On,
            (false, true) => Switch::Off,
            (false, false) => return Ok(false),
        };
        if let Some((_, first)) = self.switch {
            return Err(excluded(block, first, word));
        }
        self.switch = Some((switch, word));
        Ok(true)
    }
}

fn number(block: &Block<'_>, word: &Word<'_>) -> Result<u32, ProgramError> {
    let accepted = "a code has no sign and at most one decimal, as in G1, G43.4 or M30";
    tenths(word.digits).filter(|_| !word.negative).ok_or_else(|| block.fault_at(word, accepted.to_owned()))
}

fn excluded(block: &Block<'_>, first: &Word<'_>, second: &Word<'_>) -> ProgramError {
    let detail =
        format!("{} and {} exclude each other in a block; accepted is one of them", first.text, second.text);
    block.fault_at(second, detail)
}
