/** What the hand wants now, until what is known changes. */

import { useRef, useState } from "preact/hooks";

export function useWanted<T>(known: T): { value: T; want: (value: T) => void } {
  const before = useRef(known);
  const [wanted, want] = useState<{ value: T } | null>(null);
  if (before.current !== known) {
    before.current = known;
    if (wanted) want(null);
    return { value: known, want: (value) => want({ value }) };
  }
  return { value: wanted ? wanted.value : known, want: (value) => want({ value }) };
}
