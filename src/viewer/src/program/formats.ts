/** Formats of programs by the names of files. */

/** The formats that the service reads. */
export const FORMATS = ["apt", "gcode", "csv", "ndjson", "arrow"] as const;
export type Format = (typeof FORMATS)[number];

export const FORMAT_NAMES: Record<Format, string> = {
  apt: "CL text (APT)",
  gcode: "G-code",
  csv: "Table (CSV)",
  ndjson: "Table (NDJSON)",
  arrow: "Table (Apache Arrow)",
};

const EXTENSIONS: Record<Format, readonly string[]> = {
  apt: ["apt", "cls", "cl", "clt", "ncl", "aptsource"],
  gcode: ["nc", "ngc", "tap", "gcode", "cnc"],
  csv: ["csv"],
  ndjson: ["ndjson", "jsonl"],
  arrow: ["arrow"],
};

/** Programs of controllers that the service does not read. */
const REFUSED: Record<string, string> = { h: "Heidenhain", mpf: "Siemens", spf: "Siemens" };

/** For the attribute `accept` of a file input. */
export const ACCEPTED = Object.values(EXTENSIONS)
  .flat()
  .map((extension) => `.${extension}`)
  .join(",");

/** The format that the extension states, or null. */
export function formatOf(name: string): Format | null {
  const extension = extensionOf(name);
  return FORMATS.find((format) => EXTENSIONS[format].includes(extension)) ?? null;
}

/** The controller whose programs the service does not read, or null. */
export function refusedController(name: string): string | null {
  return REFUSED[extensionOf(name)] ?? null;
}

function extensionOf(name: string): string {
  return /\.([^.]+)$/.exec(name)?.[1]?.toLowerCase() ?? "";
}
