/** The symbols, the frames, the words for solutions, and what hands and keys do. */

import frames from "../../../../docs/frames.svg";
import { MODES, SYMBOLS } from "../words/symbols";
import { Modal } from "./modal";

const HANDS = [
  ["Drag the arrows at the tip", "moves the tool; “Dragging keeps” says what stays"],
  ["Drag the knobs φ₁, φ₂", "inclines and turns the tool on the part"],
  ["Drag beside, wheel, right button", "turns, zooms and shifts the view"],
  ["Arrow keys in the scene", "shift the view; with Shift they turn it"],
  ["Arrow keys on the time of a program", "move the machine by one row; Space plays and pauses"],
  ["Arrow keys in the text of a program", "lead to the next line that moves the machine"],
  ["Arrow keys on a slider", "move the joint by the chosen step; Page Up and Page Down by ten steps"],
  ["Ctrl+Z, Ctrl+Shift+Z", "undo and redo"],
  ["Drop a file", "opens a program, or takes a machine from its JSON file"],
] as const;

const CLAMPING = [
  [
    "Where does it run?",
    "shows the values of a number of the set-up, or of the tool’s length, with which the program runs, as marks on a slider",
  ],
  ["Find a set-up", "searches the set-up in which the program keeps the greatest distance from the limits"],
  ["Region of origins", "shows in the scene where the origin of the set-up may be"],
] as const;

const ERRORS = [
  ["Rods", "the tolerance of each rod’s length: L1, L2, L3"],
  ["Sliders", "how far each slider may stand from where the control indicates: o1, o2, o3"],
  ["Joints", "the tolerance of the joints’ places on sliders and platform: e1, e2, R1, r1, R2, r4"],
  ["Axes", "the tolerance of the places of the table’s axes; only the part stands on the table"],
  ["Angles", "the tolerance of the directions and the zero positions of the table’s axes"],
  ["worst", "the greatest error with every number within its tolerance, to the first order"],
  ["rms", "the root mean square error, if the tolerances are standard deviations and independent"],
] as const;

const MAP = [
  ["platform", "how many positions of the sliders lead to each x and y of the platform"],
  ["sliders", "how many postures each position of the sliders allows; only their differences matter"],
  ["Numbers and colours", "the number of solutions in each region; the darker or brighter, the more"],
  ["Lines", "where solutions merge; the legend names the kinds"],
  ["Hatched", "there is a solution in the working mode"],
  ["Click", "leads the machine there; the dot is its place"],
] as const;

export function Help() {
  return (
    <Modal name="Help" title="Symbols, frames and controls">
      <div class="help">
        <section aria-labelledby="symbols">
          <h3 id="symbols">Symbols</h3>
          <table>
            <tbody>
              {SYMBOLS.map(({ symbol, name, meaning }) => (
                <tr key={symbol}>
                  <th scope="row">{symbol}</th>
                  <td>
                    {name}: {meaning}
                  </td>
                </tr>
              ))}
            </tbody>
          </table>
        </section>
        <section aria-labelledby="frames">
          <h3 id="frames">Frames</h3>
          <img
            src={frames}
            loading="lazy"
            width="480"
            height="445"
            alt="Three vertical guideways with sliders carry the platform by six rods. The base frame’s z points down. The table below tilts about an axis parallel to x and turns; it carries the part frame, whose Z points up."
          />
        </section>
        <section aria-labelledby="modes">
          <h3 id="modes">Words for solutions</h3>
          <dl>
            {MODES.map(({ symbol, meaning }) => (
              <div key={symbol}>
                <dt>{symbol}</dt>
                <dd>{meaning}</dd>
              </div>
            ))}
          </dl>
        </section>
        <section aria-labelledby="clamping">
          <h3 id="clamping">Where to clamp the part of a program</h3>
          <dl>
            {CLAMPING.map(([action, effect]) => (
              <div key={action}>
                <dt>{action}</dt>
                <dd>{effect}</dd>
              </div>
            ))}
          </dl>
        </section>
        <section aria-labelledby="tolerances">
          <h3 id="tolerances">Errors of the tool</h3>
          <dl>
            {ERRORS.map(([field, meaning]) => (
              <div key={field}>
                <dt>{field}</dt>
                <dd>{meaning}</dd>
              </div>
            ))}
          </dl>
        </section>
        <section aria-labelledby="map">
          <h3 id="map">Map of solutions</h3>
          <dl>
            {MAP.map(([part, meaning]) => (
              <div key={part}>
                <dt>{part}</dt>
                <dd>{meaning}</dd>
              </div>
            ))}
          </dl>
        </section>
        <section aria-labelledby="hands">
          <h3 id="hands">Hands and keys</h3>
          <dl>
            {HANDS.map(([action, effect]) => (
              <div key={action}>
                <dt>{action}</dt>
                <dd>{effect}</dd>
              </div>
            ))}
          </dl>
        </section>
      </div>
    </Modal>
  );
}
