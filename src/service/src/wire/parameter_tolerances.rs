//! The tolerances of a machine's parameters, by name: lengths in mm, angles in degrees.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use verne_solver::error_budget::Tolerances;
use verne_solver::parameter::{PARAMETERS, Parameter, ParameterUnit};

use crate::wire::error::OperationError;
use crate::wire::field_errors::FieldErrors;
use crate::wire::parameter::of_wire;

/// Largest tolerance of a length, mm, and of an angle, degrees.
const LARGEST: [f64; 2] = [1000.0, 90.0];

macro_rules! parameter_tolerances {
    (
        $(#[$about:meta])*
        lengths: { $($(#[$length_doc:meta])* $length:ident = $of_length:ident,)* }
        angles: { $($(#[$angle_doc:meta])* $angle:ident = $of_angle:ident,)* }
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, ToSchema)]
        #[serde(deny_unknown_fields)]
        #[allow(non_snake_case, reason = "the paper's symbols: R1 and r1 are two dimensions")]
        pub(crate) struct ParameterTolerances {
            $(
                $(#[$length_doc])*
                #[serde(default, skip_serializing_if = "Option::is_none")]
                #[schema(minimum = 0, maximum = 1000, nullable = false)]
                pub $length: Option<f64>,
            )*
            $(
                $(#[$angle_doc])*
                #[serde(default, skip_serializing_if = "Option::is_none")]
                #[schema(minimum = 0, maximum = 90, nullable = false)]
                pub $angle: Option<f64>,
            )*
        }

        impl ParameterTolerances {
            /// Each parameter with its tolerance, if the request states one; in no particular order.
            fn stated(&self) -> [(Parameter, Option<f64>); PARAMETERS] {
                [$((Parameter::$of_length, self.$length),)* $((Parameter::$of_angle, self.$angle),)*]
            }

            fn field(&mut self, parameter: Parameter) -> &mut Option<f64> {
                match parameter {
                    $(Parameter::$of_length => &mut self.$length,)*
                    $(Parameter::$of_angle => &mut self.$angle,)*
                }
            }
        }
    };
}

parameter_tolerances! {
    /// A tolerance for each parameter: the standard deviation of the parameter for `rms`, and its greatest deviation
    /// for `worst`. Parameters without a tolerance are exact.
    lengths: {
        /// e1 = D1 - d1, mm.
        e1 = e1,
        /// e2 = D2 - d2, mm.
        e2 = e2,
        /// R1, mm.
        R1 = R1,
        /// r1, mm.
        r1 = r1,
        /// R2, mm.
        R2 = R2,
        /// r4, mm.
        r4 = r4,
        /// Length of both rods of leg I, mm.
        L1 = L1,
        /// Length of both rods of leg II, mm.
        L2 = L2,
        /// Length of both rods of leg III, mm.
        L3 = L3,
        /// Zero offset or positioning error of slider 1, mm.
        o1 = o1,
        /// Zero offset or positioning error of slider 2, mm.
        o2 = o2,
        /// Zero offset or positioning error of slider 3, mm.
        o3 = o3,
        /// Length of the tool from P, mm.
        tool_length = ToolLength,
        /// z of the tilting axis, mm.
        da = da,
        /// z of the table's origin in the frame of the tilting axis, mm.
        dt = dt,
        /// y of the tilting axis, mm.
        tilt_axis_y = TiltAxisY,
        /// x of the rotary axis in the frame of the tilting axis, mm.
        rotary_axis_x = RotaryAxisX,
        /// y of the rotary axis in the frame of the tilting axis, mm.
        rotary_axis_y = RotaryAxisY,
    }
    angles: {
        /// Rotation of the tilting axis about y, degrees.
        tilt_axis_b = TiltAxisB,
        /// Rotation of the tilting axis about z, degrees.
        tilt_axis_c = TiltAxisC,
        /// Zero offset or positioning error of theta1, degrees.
        tilt_zero = TiltZero,
        /// Rotation of the rotary axis about y of the frame of the tilting axis, degrees.
        rotary_axis_b = RotaryAxisB,
        /// Zero offset or positioning error of theta2, degrees.
        rotary_zero = RotaryZero,
    }
}

impl ParameterTolerances {
    /// Adds a fault for each tolerance that cannot be used, and one if no parameter has a tolerance.
    pub(crate) fn check(&self, pointer: &str, faults: &mut FieldErrors) {
        let [most_length, most_angle] = LARGEST;
        for (parameter, tolerance) in self.stated() {
            let (most, unit) = match parameter.unit() {
                ParameterUnit::Millimetre => (most_length, "mm"),
                ParameterUnit::Radian => (most_angle, "degrees"),
            };
            if tolerance.is_some_and(|tolerance| !(0.0..=most).contains(&tolerance)) {
                let detail = format!("must be a number from 0 to {most} {unit}");
                faults.add(format!("{pointer}/{}", parameter.name()), detail);
            }
        }
        if self.stated().iter().all(|(_, tolerance)| tolerance.is_none_or(|tolerance| tolerance == 0.0)) {
            faults.add(pointer, "must have a tolerance above 0 for at least one parameter");
        }
    }

    /// The tolerances that are above 0: equal requests have equal ones.
    pub(crate) fn canonical(mut self) -> Self {
        for parameter in Parameter::ALL {
            let field = self.field(parameter);
            *field = field.filter(|tolerance| *tolerance > 0.0);
        }
        self
    }

    /// Each parameter with a tolerance above 0, in the order of [`Parameter::ALL`].
    pub(crate) fn each(mut self) -> Vec<(Parameter, f64)> {
        let all = Parameter::ALL.into_iter();
        let each = all.filter_map(|parameter| Some((parameter, (*self.field(parameter))?)));
        each.filter(|(_, tolerance)| *tolerance > 0.0).collect()
    }

    /// The tolerances for the solver.
    ///
    /// # Errors
    ///
    /// The tolerances were not checked.
    pub(crate) fn to_solver(self) -> Result<Tolerances, OperationError> {
        let each = self.each().into_iter();
        let in_radians = each.map(|(parameter, tolerance)| (parameter, of_wire(parameter.unit(), tolerance)));
        Tolerances::new(in_radians).map_err(|_| OperationError::Internal)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use serde_json::{Map, Value, json};
    use verne_solver::parameter::Parameter;

    use super::ParameterTolerances;
    use crate::wire::error::OperationError;
    use crate::wire::field_errors::FieldErrors;

    fn pointers(tolerances: Value) -> Vec<String> {
        let tolerances: ParameterTolerances = serde_json::from_value(tolerances).unwrap();
        let mut faults = FieldErrors::default();
        tolerances.check("/parameter_tolerances", &mut faults);
        let Err(OperationError::Fields(faults)) = faults.into_result() else { return Vec::new() };
        faults.into_iter().map(|fault| fault.pointer).collect()
    }

    #[test]
    fn every_parameter_has_a_field_of_its_name() {
        let named: Map<String, Value> = Parameter::ALL
            .into_iter()
            .zip(1..)
            .map(|(parameter, i)| (parameter.name().into(), json!(i)))
            .collect();
        let tolerances: ParameterTolerances = serde_json::from_value(Value::Object(named)).unwrap();
        let expected: Vec<_> = Parameter::ALL.into_iter().zip((1_u8..).map(f64::from)).collect();
        assert_eq!(tolerances.each(), expected);
        let solver = tolerances.to_solver().unwrap();
        assert_eq!(solver.of(Parameter::L3), 9.0);
        assert_eq!(solver.of(Parameter::RotaryZero), 23_f64.to_radians());
    }

    #[test]
    fn tolerances_out_of_range_are_refused_at_their_name() {
        assert_eq!(
            pointers(json!({"L1": -0.1, "tilt_zero": 91, "o3": 0.1})),
            ["/parameter_tolerances/L1", "/parameter_tolerances/tilt_zero"]
        );
        assert_eq!(pointers(json!({})), ["/parameter_tolerances"]);
        assert_eq!(pointers(json!({"da": 0})), ["/parameter_tolerances"]);
        assert!(pointers(json!({"da": 1000, "rotary_zero": 90})).is_empty());
        assert!(serde_json::from_value::<ParameterTolerances>(json!({"D1": 0.1})).is_err());
    }
}
