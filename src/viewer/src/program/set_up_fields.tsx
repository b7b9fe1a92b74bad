/** Where the program stands on the table, with which tools, and how exactly the machine follows it. */

import { Choice, NumberField } from "../panels/fields";
import { OriginsSection } from "./origins_section";
import { settings, type OpenProgram } from "./program_state";
import { toolNumbers, type SetUp, type Settings, type ToolLengths } from "./settings";
import { WindowBars } from "./window_bars";

/** The length that is offered where a program states none, mm. */
const USUAL = 100;

function alter(part: Partial<Settings>): void {
  settings.value = { ...settings.peek(), ...part };
}

export function SetUpFields({ open }: { open: OpenProgram }) {
  const now = settings.value;
  return (
    <>
      <details open>
        <summary>Set-up on the table</summary>
        <Frame name="Set-up" frame={now.setup} put={(setup) => alter({ setup })} />
        {open.offsets.map((offset) => (
          <fieldset class="offset" key={offset}>
            <legend class="quiet">Work offset {offset}</legend>
            <Frame
              name={offset}
              frame={now.offsets[offset] ?? now.setup}
              put={(frame) => alter({ offsets: { ...now.offsets, [offset]: frame } })}
            />
          </fieldset>
        ))}
        <Lengths open={open} lengths={now.lengths} before={now.toolBefore} />
        <WindowBars open={open} />
        <OriginsSection />
      </details>
      <details>
        <summary>Tolerances and motion</summary>
        <Motion now={now} />
      </details>
    </>
  );
}

function Frame({ name, frame, put }: { name: string; frame: SetUp; put: (frame: SetUp) => void }) {
  const field = (axis: keyof SetUp) => {
    const angle = axis === "a" || axis === "b" || axis === "c";
    const about = { a: "x", b: "y", c: "z" }[axis as "a" | "b" | "c"];
    return (
      <NumberField
        key={axis}
        label={angle ? `${name}: turn about ${about}` : `${name}: ${axis}`}
        symbol={axis.toUpperCase()}
        unit={angle ? "°" : "mm"}
        value={frame[axis]}
        decimals={3}
        step={angle ? 1 : 10}
        commit={(value) => put({ ...frame, [axis]: value })}
      />
    );
  };
  return (
    <>
      <div class="row three">{(["x", "y", "z"] as const).map(field)}</div>
      <div class="row three">{(["a", "b", "c"] as const).map(field)}</div>
    </>
  );
}

interface LengthsProps {
  open: OpenProgram;
  lengths: ToolLengths;
  before: number | null;
}

function Lengths({ open, lengths, before }: LengthsProps) {
  const numbers = toolNumbers(open.summary.tools);
  const stated = open.summary.tools.some(({ length }) => length != null);
  const kind = typeof lengths === "object" ? "table" : typeof lengths === "number" ? "one" : "program";
  const known = (tool: number) =>
    open.summary.tools.find(({ number, length }) => number === tool && length != null)?.length ?? USUAL;
  const table = Object.fromEntries(numbers.map((tool) => [String(tool), known(tool)]));
  const options: [typeof kind, string][] = [["one", "one for all"]];
  if (stated) options.unshift(["program", "as stated"]);
  if (numbers.length > 0) options.push(["table", "by tool"]);
  return (
    <>
      <Choice
        legend="Tool lengths"
        name="tool-lengths"
        value={kind}
        options={options}
        choose={(chosen) =>
          alter({
            lengths:
              chosen === "program"
                ? "program"
                : chosen === "table"
                  ? table
                  : (Object.values(table)[0] ?? USUAL),
          })
        }
      />
      {typeof lengths === "number" && (
        <NumberField
          label="Length of every tool"
          symbol="Length"
          unit="mm"
          value={lengths}
          decimals={3}
          min={0}
          step={5}
          commit={(length) => alter({ lengths: length })}
        />
      )}
      {typeof lengths === "object" && (
        <div class="row three wrap">
          {Object.entries(lengths).map(([tool, length]) => (
            <NumberField
              key={tool}
              label={`Length of tool ${tool}`}
              symbol={`T${tool}`}
              unit="mm"
              value={length}
              decimals={3}
              min={0}
              step={5}
              commit={(value) => alter({ lengths: { ...lengths, [tool]: value } })}
            />
          ))}
        </div>
      )}
      {typeof lengths === "object" && (
        <label class="row between">
          <span class="quiet">Before the first tool</span>
          <select
            value={before ?? ""}
            onChange={({ currentTarget: { value } }) =>
              alter({ toolBefore: value === "" ? null : Number(value) })
            }
          >
            <option value="">no move is allowed</option>
            {Object.keys(lengths).map((tool) => (
              <option key={tool} value={tool}>
                T{tool} is there
              </option>
            ))}
          </select>
        </label>
      )}
    </>
  );
}

function Motion({ now }: { now: Settings }) {
  const { tolerance } = now;
  const within = (name: keyof typeof tolerance, label: string, symbol: string, most: number) => (
    <NumberField
      label={label}
      symbol={symbol}
      unit={name === "axis" ? "°" : "mm"}
      value={tolerance[name]}
      decimals={4}
      step={0.01}
      min={0.00001}
      max={most}
      commit={(value) => alter({ tolerance: { ...tolerance, [name]: value } })}
    />
  );
  return (
    <>
      <div class="row three">
        {within("tip", "Greatest deviation of the tool’s end", "Tip", 100)}
        {within("axis", "Greatest deviation of the tool’s axis", "Axis", 10)}
        {within("rapid", "Greatest deviation in rapids", "Rapids", 1000)}
      </div>
      <Choice
        legend="Orientation between points"
        name="orientation"
        value={now.orientation ?? "stated"}
        options={[
          ["stated", "as stated"],
          ["vector", "great circle"],
          ["rotary", "rotary axes"],
        ]}
        choose={(chosen) => alter({ orientation: chosen === "stated" ? null : chosen })}
      />
      <Choice
        legend="At the end of the rotary axis"
        name="on-limit"
        value={now.onLimit}
        options={[
          ["fail", "report it"],
          ["retract", "retract and rewind"],
        ]}
        choose={(onLimit) => alter({ onLimit })}
      />
      <Choice
        legend="Rapids"
        name="rapids"
        value={now.rapids}
        options={[
          ["linear", "tool on a line"],
          ["joint", "joints straight"],
        ]}
        choose={(rapids) => alter({ rapids })}
      />
      <Choice
        legend="The program moves"
        name="tip"
        value={now.tip}
        options={[
          ["end", "the tool’s end"],
          ["centre", "the ball’s centre"],
        ]}
        choose={(tip) => alter({ tip })}
      />
      <label class="check">
        <input
          type="checkbox"
          checked={now.holdRotary}
          onChange={(event) => alter({ holdRotary: event.currentTarget.checked })}
        />
        keep the program’s C where the tool is upright
      </label>
      <p class="hint">
        The tool’s radius and the least height over the table are those of the tool and the workspace.
      </p>
    </>
  );
}
