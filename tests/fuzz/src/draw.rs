//! Structured values from bytes. Equal bytes give equal values; after the last byte, values are zeros and first
//! choices.

use arbitrary::Unstructured;
use verne_solver::MAX_INPUT;

/// Special numbers.
const SPECIAL: [f64; 24] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    f64::MIN,
    f64::MIN_POSITIVE,
    5e-324,
    -5e-324,
    1e308,
    1e300,
    1e-300,
    MAX_INPUT,
    -MAX_INPUT,
    1e6,
    1e-3,
    1e-9,
    f64::EPSILON,
    std::f64::consts::PI,
    -std::f64::consts::PI,
    9_007_199_254_740_993.0,
];

/// Texts that are, or nearly are, numbers.
const NUMERALS: [&str; 36] = [
    "0",
    "-0",
    "1",
    "-1",
    "50",
    "674",
    "1000",
    "0.5",
    "-0.0",
    "1e3",
    "1E+3",
    "NaN",
    "nan",
    "-nan",
    "inf",
    "-inf",
    "Infinity",
    "+1",
    "1.",
    ".5",
    "00",
    "01",
    "1e308",
    "1e309",
    "-1e400",
    "1e-400",
    "5e-324",
    "0x10",
    "1_000",
    "1,5",
    "1e",
    "\u{661}",
    "9007199254740993",
    "18446744073709551616",
    "-9223372036854775809",
    "0.1000000000000000055511151231257827021181583404541015625",
];

/// Special texts.
const TEXTS: [&str; 20] = [
    "",
    " ",
    "verne",
    "nautilus",
    "part",
    "platform",
    "tool",
    "all",
    "working",
    "feasible",
    "glb",
    "null",
    "\0",
    "\u{feff}",
    "\u{202e}ü\u{1f6e0}",
    "../../etc",
    "a/b~c",
    "%",
    "\\ud800",
    "\"",
];

/// A stream of decisions.
pub(crate) struct Draw<'a>(Unstructured<'a>);

impl<'a> Draw<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self(Unstructured::new(bytes))
    }

    pub(crate) fn byte(&mut self) -> u8 {
        self.0.arbitrary().unwrap_or_default()
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// A number below `n`, which is at most 256.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        usize::from(self.byte()) % n
    }

    pub(crate) fn one_in(&mut self, n: usize) -> bool {
        self.below(n) == n - 1
    }

    pub(crate) fn pick<T: Copy>(&mut self, values: &[T]) -> T {
        values[self.below(values.len())]
    }

    /// From 0 to 1.
    pub(crate) fn part(&mut self) -> f64 {
        f64::from(self.0.arbitrary::<u16>().unwrap_or_default()) / f64::from(u16::MAX)
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + self.part() * (high - low)
    }

    /// Any double: one of the size of `unit`, a special value, or any pattern of bits.
    pub(crate) fn number(&mut self, unit: f64) -> f64 {
        match self.below(8) {
            0 => f64::from_bits(self.0.arbitrary().unwrap_or_default()),
            1 => self.pick(&SPECIAL),
            2 => unit * self.pick(&[0.0, 0.25, 0.5, 1.0, -0.5, -1.0]),
            3 => unit * self.between(-15.0, 7.0).exp() * self.pick(&[1.0, -1.0]),
            _ => unit * self.between(-1.5, 1.5),
        }
    }

    /// A text that is, or nearly is, a number.
    pub(crate) fn numeral(&mut self, unit: f64) -> String {
        if self.one_in(3) { self.pick(&NUMERALS).to_owned() } else { format!("{:?}", self.number(unit)) }
    }

    /// Any text.
    pub(crate) fn text(&mut self) -> String {
        if self.one_in(2) {
            String::from_utf8_lossy(self.some_bytes()).into_owned()
        } else {
            self.pick(&TEXTS).to_owned()
        }
    }

    /// Some bytes, 31 at most.
    pub(crate) fn some_bytes(&mut self) -> &'a [u8] {
        let length = self.below(32).min(self.0.len());
        self.0.bytes(length).unwrap_or_default()
    }

    /// All remaining bytes.
    pub(crate) fn rest(self) -> &'a [u8] {
        self.0.take_rest()
    }
}
