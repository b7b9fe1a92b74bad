//! A checked question about the window of a parameter.

use verne_solver::MAX_INPUT;

use crate::operations::toolpath_question::{CheckedToolpath, ToolpathQuestion};
use crate::wire::constraint::Unit;
use crate::wire::error::{FieldError, OperationError};
use crate::wire::field_errors::{FieldErrors, LARGEST_ANGLE, is_angle, is_length, is_tool_length};
use crate::wire::json::write_json;
use crate::wire::result_id::ResultId;
use crate::wire::toolpath::ToolLengths;
use crate::wire::window::{CanonicalWindow, WindowFields, WindowParameter};

/// Begins the hash of every window. It changes when the bytes of the answer to the same question change.
const HASH_PREFIX: &[u8] = b"verne window 1";

/// About the bytes of a request.
const REQUEST_BYTES: usize = 1024;

/// About how many plans a window takes.
const PLANS: f64 = 50.0;

/// The frame of `setup` by its other name.
const FIRST_OFFSET: &str = "G54";

/// A question about a window that has an answer.
#[derive(Clone, Debug)]
pub(crate) struct WindowQuestion {
    /// The tool path with the least value of the parameter.
    pub toolpath: ToolpathQuestion,
    /// The parameter.
    pub parameter: WindowParameter,
    /// Its least and its greatest value.
    pub range: [f64; 2],
    /// The id of the answer.
    pub id: ResultId,
}

/// The checked fields of a window.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CheckedWindow {
    parameter: WindowParameter,
    range: [f64; 2],
}

impl CheckedWindow {
    /// Checks the fields beside those of the tool path, in which it sets the parameter to its least value.
    ///
    /// # Errors
    ///
    /// All fields that cannot be used.
    pub(crate) fn new(fields: &WindowFields, toolpath: &mut CheckedToolpath) -> Result<Self, OperationError> {
        let WindowFields { parameter, from, to } = *fields;
        let (Some(parameter), Some(from), Some(to)) = (parameter, from, to) else {
            let missing =
                [("parameter", parameter.is_none()), ("from", from.is_none()), ("to", to.is_none())];
            let missing = missing.into_iter().filter(|(_, is_missing)| *is_missing);
            let missing = missing.map(|(name, _)| FieldError::missing(format!("/{name}"), name));
            return Err(OperationError::Fields(missing.collect()));
        };
        let mut faults = FieldErrors::default();
        check_parameter(parameter, toolpath, &mut faults);
        check_range(parameter, [from, to], toolpath, &mut faults);
        faults.into_result()?;
        let range = [from + 0.0, to + 0.0];
        toolpath.request = parameter.toolpath_with(&toolpath.request, range[0]);
        Ok(Self { parameter, range })
    }

    /// The question about a tool path.
    pub(crate) fn question(self, toolpath: ToolpathQuestion) -> WindowQuestion {
        WindowQuestion::of(toolpath, self.parameter, self.range)
    }
}

impl WindowQuestion {
    /// The question of a checked request.
    pub(crate) fn of(toolpath: ToolpathQuestion, parameter: WindowParameter, range: [f64; 2]) -> Self {
        let request = canonical(&toolpath, parameter, range);
        // Writing these fields to memory cannot fail.
        let text = write_json(&request, REQUEST_BYTES).unwrap_or_default();
        let machine = &toolpath.machine;
        let id = ResultId::of_text(HASH_PREFIX, &machine.id, &machine.data().description, &text);
        Self { toolpath, parameter, range, id }
    }

    /// The request with its default values.
    pub(crate) fn request(&self) -> CanonicalWindow {
        canonical(&self.toolpath, self.parameter, self.range)
    }

    /// Estimated work, seconds of one core.
    pub(crate) fn cost(&self) -> f64 {
        PLANS * self.toolpath.cost
    }
}

fn canonical(
    toolpath: &ToolpathQuestion,
    parameter: WindowParameter,
    [from, to]: [f64; 2],
) -> CanonicalWindow {
    CanonicalWindow { toolpath: toolpath.request.clone(), parameter, from, to }
}

fn check_parameter(parameter: WindowParameter, toolpath: &CheckedToolpath, faults: &mut FieldErrors) {
    let request = &toolpath.request;
    match parameter {
        WindowParameter::ToolLength => {
            if matches!(request.tool_length, Some(ToolLengths::Table(_))) {
                faults.add(
                    "/tool_length",
                    "must be one number, or missing: parameter is the length of every tool",
                );
            }
        }
        _ if request.offsets.contains_key(FIRST_OFFSET) => {
            faults.add("/parameter", "has no effect where offsets states G54: give this frame as setup");
        }
        WindowParameter::A | WindowParameter::B if request.hold_rotary => {
            let detail =
                "cannot incline the frame with hold_rotary: the program's C is then no angle of the table";
            faults.add("/parameter", detail);
        }
        _ => {}
    }
}

fn check_range(
    parameter: WindowParameter,
    [from, to]: [f64; 2],
    toolpath: &CheckedToolpath,
    faults: &mut FieldErrors,
) {
    let is_angular = parameter.unit() == Unit::Degree;
    let (accepts, allowed): (fn(f64) -> bool, _) = match parameter {
        WindowParameter::ToolLength => (is_tool_length, format!("a number from 0 to {MAX_INPUT:e} mm")),
        _ if is_angular => (is_angle, format!("a number within ±{LARGEST_ANGLE} degrees")),
        _ => (is_length, format!("a number within ±{MAX_INPUT:e} mm")),
    };
    for (pointer, value) in [("/from", from), ("/to", to)] {
        if !accepts(value) {
            faults.add(pointer, format!("must be {allowed}"));
        } else if !is_angular {
            faults.proportion(pointer, value, &toolpath.machine);
        }
    }
    if accepts(from) && accepts(to) && from >= to {
        faults.add("/to", "must be greater than from");
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use serde_json::json;

    use super::CheckedWindow;
    use crate::operations::machine_registry::MachineRegistry;
    use crate::operations::question::Question;
    use crate::operations::toolpath_request::read_fields;
    use crate::wire::parse::parse_body;
    use crate::wire::window::WindowBody;

    #[test]
    fn a_worker_reads_the_same_question_from_its_text() {
        let body =
            json!({"program": {"points": [[0, 0, 300], [10, 0, 300]]}, "parameter": "setup.x", "from": 0.1,
                          "to": 20, "setup": {"x": 5, "y": 1}})
            .to_string();
        let request: WindowBody = parse_body(body.as_bytes()).unwrap();
        let (mut checked, source) = read_fields(&request.toolpath, &MachineRegistry::default()).unwrap();
        let fields = CheckedWindow::new(&request.more, &mut checked).unwrap();
        let question = Question::Window(Box::new(fields.question(checked.question(source.id()))));
        let read = Question::from_text(&question.to_text(None).unwrap(), question.id()).unwrap();
        assert_eq!(read.id(), question.id());
        let Question::Window(read) = read else { unreachable!("the kind is in the text") };
        assert_eq!((read.range, read.toolpath.request.setup.x), ([0.1, 20.0], 0.1));
    }
}
