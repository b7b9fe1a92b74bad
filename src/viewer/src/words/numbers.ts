/** Numbers with units, for people. */

const THIN = "\u202f";

/** Thousands apart, a true minus, fixed decimals. */
export function number(value: number, decimals = 1): string {
  const fixed = Math.abs(value).toFixed(decimals);
  const [whole = "0", part] = fixed.split(".");
  const sign = value < 0 && Number(fixed) !== 0 ? "\u2212" : "";
  const grouped = whole.replace(/\B(?=(\d{3})+$)/g, THIN);
  return sign + grouped + (part ? `.${part}` : "");
}

export function mm(value: number, decimals = 1): string {
  return `${number(value, decimals)}\u00a0mm`;
}

export function degrees(value: number, decimals = 1): string {
  return `${number(value, decimals)}°`;
}

/** A volume given in mm³. */
export function cubicMetres(value: number): string {
  return `${number(value / 1e9, 6)}\u00a0m³`;
}

/** An area given in mm². */
export function squareMetres(value: number): string {
  return `${number(value / 1e6, 4)}\u00a0m²`;
}

export function withUnit(value: number, unit: "mm" | "deg" | "1"): string {
  if (unit === "mm") return mm(value);
  return unit === "deg" ? degrees(value) : number(value, 3);
}
