/** The program's text: only the lines that are seen are in the page. */

import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { pause, seekLine } from "./player";
import { currentLine, faults, plan, program, shownLine } from "./program_state";

const ROW = 18;
/** Browsers draw no element that is much higher, pixels. */
const HIGHEST = 8_000_000;

export function TextList() {
  const box = useRef<HTMLDivElement>(null);
  const [seen, setSeen] = useState({ top: 0, height: 200 });
  const text = program.value?.text;
  const count = text?.count ?? 0;
  const full = count * ROW;
  const height = Math.min(full, HIGHEST);
  // How many pixels of text pass for each pixel that is scrolled.
  const ratio = height > seen.height ? Math.max((full - seen.height) / (height - seen.height), 1) : 1;
  const offset = seen.top * ratio;
  const first = Math.max(Math.floor(offset / ROW) - 2, 0);
  const shown = Math.min(Math.ceil(seen.height / ROW) + 5, count - first);
  const current = currentLine.value;
  const wanted = shownLine.value || current;

  useEffect(() => {
    const element = box.current;
    if (!element) return;
    const look = () => setSeen({ top: element.scrollTop, height: element.clientHeight });
    const sizes = new ResizeObserver(look);
    sizes.observe(element);
    look();
    return () => sizes.disconnect();
  }, []);
  // The current line stays in sight.
  useLayoutEffect(() => {
    const element = box.current;
    if (!element || wanted === 0) return;
    const top = (wanted - 1) * ROW;
    const view = element.clientHeight;
    if (top >= offset && top + ROW <= offset + view) return;
    element.scrollTop = Math.max(top - view / 3, 0) / ratio;
    // Before the next picture: the event of the scroll comes later.
    setSeen({ top: element.scrollTop, height: view });
  }, [wanted]);
  // Once the machine moves on, the text follows it again.
  useEffect(() => {
    shownLine.value = 0;
  }, [current]);

  if (!text) return <p class="hint text-list">This format has no text.</p>;
  const failing = plan.value?.report.failures ?? [];
  const faulty = faults.value;
  const fails = (line: number) =>
    failing.some(({ lines: [from = 0, to = 0] }) => from <= line && line <= to) ||
    faulty.some((fault) => fault.line === line);
  const go = (line: number) => {
    pause();
    seekLine(Math.min(Math.max(line, 1), count));
  };
  const page = Math.max(Math.floor(seen.height / ROW) - 1, 1);
  const steps: Record<string, number> = {
    ArrowDown: current + 1,
    ArrowUp: current - 1,
    PageDown: current + page,
    PageUp: current - page,
    Home: 1,
    End: count,
  };
  return (
    <div
      ref={box}
      class="text-list"
      role="listbox"
      tabIndex={0}
      aria-label="Program text"
      aria-activedescendant={current > first && current <= first + shown ? `line-${current}` : undefined}
      onScroll={(event) =>
        setSeen({ top: event.currentTarget.scrollTop, height: event.currentTarget.clientHeight })
      }
      onKeyDown={(event) => {
        const line = steps[event.key];
        if (line === undefined) return;
        event.preventDefault();
        nextMoving(line, line < current ? -1 : 1, go);
      }}
    >
      <div role="presentation" class="all-lines" style={{ height: `${height}px` }}>
        {Array.from({ length: Math.max(shown, 0) }, (_, i) => {
          const line = first + i + 1;
          // Relative to the place of the scroll bar, which moves less than the text where there are many lines.
          const y = (line - 1) * ROW - offset + seen.top;
          return (
            <div
              key={line}
              id={`line-${line}`}
              role="option"
              aria-selected={line === current}
              aria-posinset={line}
              aria-setsize={count}
              class={`${line === current ? "current" : ""} ${fails(line) ? "failing" : ""}`}
              style={{ transform: `translateY(${y}px)` }}
              onClick={() => go(line)}
            >
              <span class="number">{line}</span>
              <code>{text.line(line)}</code>
            </div>
          );
        })}
      </div>
    </div>
  );
}

/** Goes to a line; from there to the next one in this direction whose motion the plan has. */
function nextMoving(line: number, direction: 1 | -1, go: (line: number) => void): void {
  const rows = plan.peek()?.rows;
  if (!rows) return;
  const lines = rows.line.subarray(0, rows.count);
  let best: number | null = null;
  for (const at of lines) {
    const beyond = (at - line) * direction >= 0;
    if (beyond && (best === null || (at - best) * direction < 0)) best = at;
  }
  go(best ?? line);
}
