//! One row, and how it is written in JSON.

use std::fmt;

use serde::Deserialize;
use serde::de::{self, Deserializer, MapAccess, SeqAccess, Visitor};
use serde::ser::{Serialize, SerializeMap, Serializer};

use crate::moves::MoveKind;

/// A row of a program.
///
/// In JSON it is an array of 3, 5 or 6 numbers, `[x, y, z]`, `[x, y, z, phi1, phi2]` or `[x, y, z, i, j, k]`, or an
/// object with these names and optionally `feed`, `kind` and `line`. An object with another name is refused: a misspelt
/// `phi1` would be a row without an orientation.
///
/// ```
/// use verne_program::{Row, RowOrientation};
///
/// let row: Row = serde_json::from_str(r#"{"x": 1, "y": 2, "z": 3, "phi1": 20, "phi2": 45, "feed": 800}"#)?;
/// assert_eq!(row.orientation, RowOrientation::Rotary([20.0, 45.0]));
/// let row: Row = serde_json::from_str("[1, 2, 3, 0, 0, 1]")?;
/// assert_eq!((row.tip, row.feed), ([1.0, 2.0, 3.0], None));
/// assert_eq!(serde_json::to_string(&row)?, "[1.0,2.0,3.0,0.0,0.0,1.0]");
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// The tip, in the unit of the program.
    pub tip: [f64; 3],
    /// The orientation.
    pub orientation: RowOrientation,
    /// Units per minute, or degrees per minute if only the axis moves. Without one the drives decide.
    pub feed: Option<f64>,
    /// Whether the row is reached by cutting. The default is feed.
    pub kind: MoveKind,
    /// The line to report instead of the row's own.
    pub line: Option<u32>,
}

/// The orientation of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RowOrientation {
    /// None: the axis is (0, 0, 1).
    None,
    /// The axis i, j, k from tip to holder, of any length.
    Vector([f64; 3]),
    /// The rotary words phi1 and phi2 in degrees.
    Rotary([f64; 2]),
}

/// The named values of a row before it is known whether they are a row.
#[derive(Debug, Default)]
pub(crate) struct Named {
    pub(crate) x: Option<f64>,
    pub(crate) y: Option<f64>,
    pub(crate) z: Option<f64>,
    pub(crate) i: Option<f64>,
    pub(crate) j: Option<f64>,
    pub(crate) k: Option<f64>,
    pub(crate) phi1: Option<f64>,
    pub(crate) phi2: Option<f64>,
    pub(crate) feed: Option<f64>,
    pub(crate) kind: Option<MoveKind>,
    pub(crate) line: Option<u32>,
}

impl Named {
    /// The number of a name; `None` for other names.
    pub(crate) fn number(&mut self, name: &str) -> Option<&mut Option<f64>> {
        Some(match name {
            "x" => &mut self.x,
            "y" => &mut self.y,
            "z" => &mut self.z,
            "i" => &mut self.i,
            "j" => &mut self.j,
            "k" => &mut self.k,
            "phi1" => &mut self.phi1,
            "phi2" => &mut self.phi2,
            "feed" => &mut self.feed,
            _ => return None,
        })
    }
}

/// The names that a row needs, and those that it may have.
pub(crate) const NAMES: &str =
    "x, y, z; then i, j, k, or phi1, phi2, or no orientation; optionally feed, kind, line";

impl Named {
    /// The row, or what is missing.
    pub(crate) fn row(&self) -> Result<Row, &'static str> {
        let (Some(x), Some(y), Some(z)) = (self.x, self.y, self.z) else {
            return Err("a row needs x, y and z");
        };
        let orientation = match ([self.i, self.j, self.k], [self.phi1, self.phi2]) {
            ([None, None, None], [None, None]) => RowOrientation::None,
            ([Some(i), Some(j), Some(k)], [None, None]) => RowOrientation::Vector([i, j, k]),
            ([None, None, None], [Some(phi1), Some(phi2)]) => RowOrientation::Rotary([phi1, phi2]),
            _ => return Err("the orientation is incomplete or stated twice"),
        };
        let kind = self.kind.unwrap_or(MoveKind::Feed);
        Ok(Row { tip: [x, y, z], orientation, feed: self.feed, kind, line: self.line })
    }
}

impl<'de> Deserialize<'de> for Row {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(RowVisitor)
    }
}

/// The shortest form: an array unless the row has a feed, is a rapid, or states its line.
impl Serialize for Row {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (names, words): (&[&str], &[f64]) = match &self.orientation {
            RowOrientation::None => (&[], &[]),
            RowOrientation::Vector(axis) => (&["i", "j", "k"], axis),
            RowOrientation::Rotary(words) => (&["phi1", "phi2"], words),
        };
        if self.feed.is_none() && self.kind == MoveKind::Feed && self.line.is_none() {
            return serializer.collect_seq(self.tip.iter().chain(words));
        }
        let mut map = serializer.serialize_map(None)?;
        for (name, value) in ["x", "y", "z"].iter().chain(names).zip(self.tip.iter().chain(words)) {
            map.serialize_entry(name, value)?;
        }
        if let Some(feed) = self.feed {
            map.serialize_entry("feed", &feed)?;
        }
        if self.kind != MoveKind::Feed {
            map.serialize_entry("kind", &self.kind)?;
        }
        if let Some(line) = self.line {
            map.serialize_entry("line", &line)?;
        }
        map.end()
    }
}

/// The names that an object may have. The parser refuses others, and lists these.
#[derive(Deserialize)]
#[serde(field_identifier, rename_all = "lowercase")]
enum Name {
    X,
    Y,
    Z,
    I,
    J,
    K,
    Phi1,
    Phi2,
    Feed,
    Kind,
    Line,
}

struct RowVisitor;

impl<'de> Visitor<'de> for RowVisitor {
    type Value = Row;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an array of 3, 5 or 6 numbers, or an object with x, y, z")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Row, A::Error> {
        let mut numbers = [0.0; 6];
        let mut count = 0;
        while let Some(number) = seq.next_element::<f64>()? {
            let place = numbers.get_mut(count).ok_or_else(|| de::Error::invalid_length(count + 1, &self))?;
            *place = number;
            count += 1;
        }
        let [x, y, z, fourth, fifth, sixth] = numbers;
        let orientation = match count {
            3 => RowOrientation::None,
            5 => RowOrientation::Rotary([fourth, fifth]),
            6 => RowOrientation::Vector([fourth, fifth, sixth]),
            _ => return Err(de::Error::invalid_length(count, &self)),
        };
        Ok(Row { tip: [x, y, z], orientation, feed: None, kind: MoveKind::Feed, line: None })
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Row, A::Error> {
        let mut named = Named::default();
        while let Some(name) = map.next_key()? {
            match name {
                Name::X => fill(&mut named.x, &mut map, "x")?,
                Name::Y => fill(&mut named.y, &mut map, "y")?,
                Name::Z => fill(&mut named.z, &mut map, "z")?,
                Name::I => fill(&mut named.i, &mut map, "i")?,
                Name::J => fill(&mut named.j, &mut map, "j")?,
                Name::K => fill(&mut named.k, &mut map, "k")?,
                Name::Phi1 => fill(&mut named.phi1, &mut map, "phi1")?,
                Name::Phi2 => fill(&mut named.phi2, &mut map, "phi2")?,
                Name::Feed => fill(&mut named.feed, &mut map, "feed")?,
                Name::Kind => fill(&mut named.kind, &mut map, "kind")?,
                Name::Line => fill(&mut named.line, &mut map, "line")?,
            }
        }
        named.row().map_err(de::Error::custom)
    }
}

/// Reads a value, which may be null, once.
fn fill<'de, T, A>(place: &mut Option<T>, map: &mut A, name: &'static str) -> Result<(), A::Error>
where
    T: Deserialize<'de>,
    A: MapAccess<'de>,
{
    if place.is_some() {
        return Err(de::Error::duplicate_field(name));
    }
    *place = map.next_value()?;
    Ok(())
}
