/** Whether values of JSON are equal; the order of fields counts. */
export function equal(a: unknown, b: unknown): boolean {
  return JSON.stringify(a) === JSON.stringify(b);
}
