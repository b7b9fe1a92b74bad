/** The lines of a program's file. Only the bytes are kept: lines become text when they are shown. */

const NEW_LINE = 10;
const RETURN = 13;
/** Characters of a line that are shown. */
const LONGEST = 400;

export class ProgramText {
  /** Where each line begins. */
  private readonly starts: Uint32Array;
  private readonly decoder = new TextDecoder("utf-8");
  readonly count: number;

  constructor(private readonly bytes: Uint8Array) {
    let lines = 1;
    for (let at = bytes.indexOf(NEW_LINE); at >= 0; at = bytes.indexOf(NEW_LINE, at + 1)) lines += 1;
    // The end of the last line begins no other.
    if (bytes.length === 0 || bytes[bytes.length - 1] === NEW_LINE) lines -= 1;
    this.starts = new Uint32Array(lines);
    let at = 0;
    for (let line = 0; line < lines; line += 1) {
      this.starts[line] = at;
      at = bytes.indexOf(NEW_LINE, at) + 1;
    }
    this.count = lines;
  }

  /** A line by its number, from 1. */
  line(number: number): string {
    const from = this.starts[number - 1];
    if (from === undefined) return "";
    let to = number < this.count ? (this.starts[number] ?? 0) - 1 : this.bytes.length;
    if (number === this.count && this.bytes[to - 1] === NEW_LINE) to -= 1;
    if (this.bytes[to - 1] === RETURN) to -= 1;
    const text = this.decoder.decode(this.bytes.subarray(from, Math.min(to, from + 4 * LONGEST)));
    return text.length > LONGEST ? `${text.slice(0, LONGEST)} …` : text;
  }
}

/** The work offsets beside G54 that a G-code program calls, in the order of their names. */
export function workOffsets(text: ProgramText): string[] {
  const found = new Set<string>();
  for (let line = 1; line <= text.count; line += 1) {
    for (const [, name = ""] of text
      .line(line)
      .matchAll(/(?:^|[^A-Z])(G5(?:[5-8]|9(?:\.[123])?))(?![\d.])/gi))
      found.add(name.toUpperCase());
  }
  return [...found].sort();
}
