/** Over the scene: how to measure, and what was measured. */

import { measurement, measuring } from "../state/measurement";
import { mm, number } from "../words/numbers";

export function MeasurementCaption() {
  const found = measurement.value;
  const words = found
    ? `${mm(found.distance)}: x ${number(found.along[0])}, y ${number(found.along[1])}, z ${mm(found.along[2])} in the base frame`
    : "Click two points. Joints, tip and platform attract the pointer.";
  return (
    <div role="status">
      {measuring.value && (
        <p class="caption" data-testid="measurement">
          {words}
        </p>
      )}
    </div>
  );
}
