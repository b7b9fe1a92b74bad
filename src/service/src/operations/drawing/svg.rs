//! Pages of SVG with a title and axes. One unit of the view is 1 mm.

use std::fmt::Write;

use crate::operations::drawing::extent::Extent;
use crate::wire::fixed_array::Pair;

/// Margin around the drawing as a fraction of its larger side.
const MARGIN: f64 = 0.12;

/// The colour of a tick.
const TICK: &str = r##"stroke="#333333""##;

/// About how many ticks an axis has.
const TICKS: f64 = 8.0;

/// Appends a line as a path of SVG. y points down in SVG and up in the drawing.
pub(crate) fn path(text: &mut String, points: &[Pair]) {
    for (i, point) in points.iter().enumerate() {
        let [x, y] = point.0;
        let _ = write!(text, "{}{x:.4} {:.4}", if i == 0 { 'M' } else { 'L' }, 0.0 - y);
    }
}

/// What stands above a drawing, and what its axes are.
pub(crate) struct Heading<'a> {
    /// The first line.
    pub title: &'a str,
    /// The second line: which way the drawing is seen.
    pub seen: &'a str,
    /// The figures that the description of the file states.
    pub figures: &'a str,
    /// The names of the axes.
    pub axes: [&'a str; 2],
}

/// The page of the drawing, mm, y up.
pub(crate) struct Page {
    min: [f64; 2],
    max: [f64; 2],
    /// The drawing's larger side. Lines are as wide as a fraction of it.
    pub size: f64,
    /// Height of letters.
    pub letters: f64,
}

impl Page {
    /// The page of a drawing with this extent.
    pub(crate) fn around(extent: Extent) -> Self {
        let (size, letters) = (extent.size(), extent.letter_height());
        let margin = MARGIN * size;
        let [min, max] =
            [extent.min.map(|least| least - margin), extent.max.map(|greatest| greatest + margin)];
        Self { min, max, size, letters }
    }

    /// The whole file with these contents.
    pub(crate) fn write(&self, heading: &Heading<'_>, contents: &str) -> String {
        let mut svg = self.open(heading);
        svg.push_str(contents);
        self.axes(&mut svg, heading.axes.map(escaped));
        svg.push_str("</g>\n</svg>\n");
        svg
    }

    /// The place of a line of text below the axes.
    pub(crate) fn footer(&self) -> [f64; 2] {
        [self.min[0] + self.letters, -self.min[1] - 0.4 * self.letters]
    }

    fn open(&self, heading: &Heading<'_>) -> String {
        let [width, height] = [self.max[0] - self.min[0], self.max[1] - self.min[1]];
        let (title, seen) = (escaped(heading.title), heading.seen);
        let letters = self.letters;
        // Page and view agree to the last digit. Otherwise a unit of the view would not be 1 mm.
        let [width, height] = [width, height].map(|side| format!("{side:.4}"));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" \
             viewBox=\"{:.4} {:.4} {width} {height}\">\n<title>{title}</title>\n\
             <desc>mm; {seen}; {}</desc>\n\
             <rect x=\"{0:.4}\" y=\"{1:.4}\" width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n\
             <g font-family=\"sans-serif\" font-size=\"{letters:.3}\" stroke-width=\"{:.3}\">\n\
             <text x=\"{4:.3}\" y=\"{5:.3}\">{title}</text>\n\
             <text x=\"{4:.3}\" y=\"{6:.3}\">{seen}</text>\n",
            self.min[0],
            -self.max[1],
            heading.figures,
            0.002 * self.size,
            self.min[0] + letters,
            1.5 * letters - self.max[1],
            2.8 * letters - self.max[1],
        )
    }

    /// A scale along the lower and one along the left side.
    fn axes(&self, svg: &mut String, [horizontal, vertical]: [String; 2]) {
        let step = round_step(self.size / TICKS);
        let (letters, tick) = (self.letters, 0.01 * self.size);
        let [left, bottom] = self.min.map(|least| least + 3.0 * letters);
        let _ = writeln!(
            svg,
            r##"<path d="M{left:.3} {:.3}V{:.3}H{:.3}" fill="none" stroke="#333333"/>"##,
            3.6 * letters - self.max[1],
            -bottom,
            self.max[0] - letters
        );
        for x in ticks(left, self.max[0] - 2.0 * letters, step) {
            let _ = writeln!(
                svg,
                r#"<path d="M{x} {:.3}v{tick:.3}" {TICK}/><text x="{x}" y="{:.3}" text-anchor="middle">{x}</text>"#,
                -bottom,
                tick + letters - bottom
            );
        }
        for y in ticks(bottom, self.max[1] - 5.0 * letters, step) {
            let _ = writeln!(
                svg,
                r#"<path d="M{left:.3} {0}h{1:.3}" {TICK}/><text x="{2:.3}" y="{3:.3}" text-anchor="end">{y}</text>"#,
                0.0 - y,
                -tick,
                left - 1.3 * tick,
                0.35 * letters - y
            );
        }
        let [right, above] = [self.max[0] - letters, -bottom - 0.4 * letters];
        let [beside, top] = [left + 0.4 * letters, 4.4 * letters - self.max[1]];
        let _ = writeln!(
            svg,
            "<text x=\"{right:.3}\" y=\"{above:.3}\" text-anchor=\"end\">{horizontal}, mm</text>\
             <text x=\"{beside:.3}\" y=\"{top:.3}\">{vertical}, mm</text>"
        );
    }
}

/// The text with XML's escapes. Characters that XML does not allow become U+FFFD.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '\u{FFFE}' | '\u{FFFF}' => escaped.push(char::REPLACEMENT_CHARACTER),
            c if c.is_control() => escaped.push(char::REPLACEMENT_CHARACTER),
            c => escaped.push(c),
        }
    }
    escaped
}

/// 1, 2 or 5 times a power of ten.
fn round_step(about: f64) -> f64 {
    let power = 10_f64.powf(about.log10().floor());
    let times = [1.0, 2.0, 5.0].into_iter().find(|times| times * power >= about).unwrap_or(10.0);
    times * power
}

/// The multiples of a step between two numbers.
fn ticks(from: f64, to: f64, step: f64) -> impl Iterator<Item = f64> {
    let first = (from / step).ceil();
    (0..).map(move |i| (first + f64::from(i)) * step + 0.0).take_while(move |tick| *tick <= to)
}
