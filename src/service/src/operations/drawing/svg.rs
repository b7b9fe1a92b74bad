//! Slices as SVG. One unit of the view is 1 mm.

use std::fmt::Write;

use crate::operations::drawing::extent::{EMPTY_SLICE, Extent, displayed};
use crate::wire::fixed_array::Pair;
use crate::wire::slice::SliceObject;
use crate::wire::workspace::FrameName;

/// Margin around the drawing as a fraction of its larger side.
const MARGIN: f64 = 0.12;

/// The colour of a tick.
const TICK: &str = r##"stroke="#333333""##;

/// About how many ticks an axis has.
const TICKS: f64 = 8.0;

/// Draws a slice.
pub(crate) fn write(slice: &SliceObject, title: &str) -> String {
    let page = Page::around(slice);
    let mut svg = page.open(slice, title);
    let mut outline = String::new();
    for polygon in &slice.polygons {
        for ring in std::iter::once(&polygon.outer).chain(&polygon.holes) {
            path(&mut outline, ring);
            outline.push('Z');
        }
    }
    // Writing to a string cannot fail.
    let _ = writeln!(
        svg,
        r##"<path d="{outline}" fill="#56b4e9" fill-opacity="0.45" fill-rule="evenodd" stroke="#0072b2"/>"##
    );
    for line in &slice.contours {
        let mut along = String::new();
        path(&mut along, &line.points);
        let alpha = displayed(line.alpha);
        let _ = writeln!(
            svg,
            r##"<path d="{along}" fill="none" stroke="#d55e00"><title>alpha = {alpha}°</title></path>"##
        );
        if let Some(&[x, y]) = line.points.first().map(|point| &point.0) {
            let _ = writeln!(svg, r##"<text x="{x:.2}" y="{:.2}" fill="#d55e00">{alpha}°</text>"##, -y);
        }
    }
    page.axes(&mut svg);
    svg.push_str("</g>\n</svg>\n");
    svg
}

/// y points down in SVG and up in the drawing.
fn path(text: &mut String, points: &[Pair]) {
    for (i, point) in points.iter().enumerate() {
        let [x, y] = point.0;
        let _ = write!(text, "{}{x:.4} {:.4}", if i == 0 { 'M' } else { 'L' }, 0.0 - y);
    }
}

/// The page of the drawing, mm, y up.
struct Page {
    min: [f64; 2],
    max: [f64; 2],
    /// The drawing's larger side. Lines are as wide as a fraction of it.
    size: f64,
    /// Height of letters.
    letters: f64,
}

impl Page {
    fn around(slice: &SliceObject) -> Self {
        let extent = Extent::of(slice).unwrap_or(EMPTY_SLICE);
        let (size, letters) = (extent.size(), extent.letter_height());
        let margin = MARGIN * size;
        let [min, max] =
            [extent.min.map(|least| least - margin), extent.max.map(|greatest| greatest + margin)];
        Self { min, max, size, letters }
    }

    fn open(&self, slice: &SliceObject, title: &str) -> String {
        let [width, height] = [self.max[0] - self.min[0], self.max[1] - self.min[1]];
        let seen = match slice.frame {
            FrameName::Base => "base frame, y up: seen from below, as z points down",
            FrameName::Part => "part frame, y up: seen from above",
        };
        let title = escaped(title);
        let letters = self.letters;
        // Page and view agree to the last digit. Otherwise a unit of the view would not be 1 mm.
        let [width, height] = [width, height].map(|side| format!("{side:.4}"));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" \
             viewBox=\"{:.4} {:.4} {width} {height}\">\n<title>{title}</title>\n\
             <desc>mm; {seen}; area {:.3} mm²; {}</desc>\n\
             <rect x=\"{0:.4}\" y=\"{1:.4}\" width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n\
             <g font-family=\"sans-serif\" font-size=\"{letters:.3}\" stroke-width=\"{:.3}\">\n\
             <text x=\"{5:.3}\" y=\"{6:.3}\">{title}</text>\n\
             <text x=\"{5:.3}\" y=\"{7:.3}\">{seen}</text>\n",
            self.min[0],
            -self.max[1],
            slice.area,
            slice.id,
            0.002 * self.size,
            self.min[0] + letters,
            1.5 * letters - self.max[1],
            2.8 * letters - self.max[1],
        )
    }

    /// A scale along the lower and one along the left side.
    fn axes(&self, svg: &mut String) {
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
        let _ = writeln!(
            svg,
            r#"<text x="{:.3}" y="{:.3}" text-anchor="end">x, mm</text><text x="{:.3}" y="{:.3}">y, mm</text>"#,
            self.max[0] - letters,
            -bottom - 0.4 * letters,
            left + 0.4 * letters,
            4.4 * letters - self.max[1]
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
