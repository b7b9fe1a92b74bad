//! Broken limits in words.

use serde::Deserialize;

use crate::wire::limit::Limit;

/// A margin worse than this is no distance: the position is out of proportion to the machine.
const OUT_OF_PROPORTION: f64 = 1e9;

/// A limit with its margin, as answers and reports state it.
#[derive(Debug, Deserialize)]
pub(crate) struct NamedLimit {
    pub constraint: String,
    pub element: String,
    pub margin: f64,
    pub unit: String,
}

impl From<&Limit> for NamedLimit {
    fn from(limit: &Limit) -> Self {
        Self {
            constraint: limit.constraint.to_string(),
            element: limit.element.to_string(),
            margin: limit.value,
            unit: limit.unit.name().to_owned(),
        }
    }
}

impl NamedLimit {
    /// What is wrong, as a clause.
    pub(crate) fn in_words(&self) -> String {
        let (missing, element) = (-self.margin, self.element.as_str());
        if missing > OUT_OF_PROPORTION {
            return "the position is far out of reach".to_owned();
        }
        let amount = match self.unit.as_str() {
            "1" => rounded(missing),
            unit => format!("{} {}", rounded(missing), if unit == "deg" { "degrees" } else { unit }),
        };
        let (part, end) = element.split_once('.').unwrap_or((element, ""));
        let end = if end == "max" { "high" } else { "low" };
        match self.constraint.as_str() {
            "stroke" => format!("slider {} is {amount} past the {end} end of its stroke", number(part)),
            "leg_length" => format!("leg {} is {amount} too short", number(part)),
            "slider_joint" => format!("the slider joint of rod {} is {amount} beyond its cone", number(part)),
            "platform_joint" => {
                format!("the platform joint of rod {} is {amount} beyond its cone", number(part))
            }
            "rod_crossing" => format!("the rods of leg I are crossed by {amount}"),
            "rod_interference" => format!("the rods {} are {amount} too close", number(part)),
            "tilt" | "rotary" => format!("{part} is {amount} past the {end} end of its range"),
            "table_clearance" if part == "tool" => format!("the tool is {amount} too close to the table"),
            "table_clearance" => format!("the joint {} is {amount} too close to the table", number(part)),
            "serial_singularity" => {
                format!("rod {} is too close to a serial singularity, by {amount}", number(part))
            }
            "parallel_singularity" => {
                format!("the platform is too close to a parallel singularity, by {amount}")
            }
            other => format!("{other} ({element}) is exceeded by {amount}"),
        }
    }
}

/// The number in a name: `2` in `slider2`, `11-31` in `rods11-31`.
fn number(part: &str) -> &str {
    part.trim_start_matches(|c: char| c.is_ascii_alphabetic())
}

/// A number with three significant digits, or its whole part.
pub(crate) fn rounded(number: f64) -> String {
    let digits = if number.abs() >= 100.0 {
        0
    } else if number.abs() >= 10.0 {
        1
    } else if number.abs() >= 1.0 {
        2
    } else if number.abs() >= 0.001 {
        4
    } else {
        return if number == 0.0 { "0".to_owned() } else { format!("{number:.1e}") };
    };
    format!("{number:.digits$}")
}

#[cfg(test)]
mod tests {
    use super::NamedLimit;

    #[test]
    fn limits_are_said_in_words() {
        for (constraint, element, margin, unit, words) in [
            ("stroke", "slider2.min", -12.34, "mm", "slider 2 is 12.3 mm past the low end of its stroke"),
            ("rotary", "theta2.max", -5.0, "deg", "theta2 is 5.00 degrees past the high end of its range"),
            ("rod_interference", "rods11-31", -0.5, "mm", "the rods 11-31 are 0.5000 mm too close"),
            ("leg_length", "leg3", -1234.5, "mm", "leg 3 is 1234 mm too short"),
            ("leg_length", "leg1", f64::MIN, "mm", "the position is far out of reach"),
            ("table_clearance", "joint21", -2e-5, "mm", "the joint 21 is 2.0e-5 mm too close to the table"),
            (
                "parallel_singularity",
                "platform",
                -0.02,
                "1",
                "the platform is too close to a parallel singularity, by 0.0200",
            ),
        ] {
            let [constraint, element, unit] = [constraint, element, unit].map(str::to_owned);
            assert_eq!(NamedLimit { constraint, element, margin, unit }.in_words(), words);
        }
    }
}
