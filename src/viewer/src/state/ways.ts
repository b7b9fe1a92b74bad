/** Finds how far each joint alone can move, by samples that are examined together. */

/** One end of a joint's way. */
export interface WayEnd {
  at: number;
  /** The limit that would be broken beyond; null at the end of the joint's travel. */
  limit: string | null;
}

export interface Way {
  low: WayEnd;
  high: WayEnd;
}

/** Names the limit that each row of joints breaks; null for a row that keeps all. */
export type Examine = (rows: number[][]) => Promise<(string | null)[]>;

/** Samples between a joint and the end of its travel; a forbidden gap between two of them is not seen. */
const SAMPLES = 48;
const ROUNDS = 3;

interface Search {
  joint: number;
  /** The last value that keeps all limits, and one farther on: the end of the travel, or a value that breaks one. */
  good: number;
  far: number;
  limit: string | null;
}

/** Each joint's way about a posture that keeps every limit, to the travel divided by SAMPLES to the power of ROUNDS. */
export async function waysOf(joints: number[], travel: [number, number][], examine: Examine): Promise<Way[]> {
  const searches: Search[] = joints.flatMap((good, joint) =>
    (travel[joint] ?? []).map((far) => ({ joint, good, far, limit: null })),
  );
  for (let round = 0; round < ROUNDS; round += 1) {
    // A joint that reaches the end of its travel needs no second look.
    const open = searches.filter(({ limit }) => round === 0 || limit !== null);
    const values = open.map(({ good, far }) => steps(good, far));
    const rows = open.flatMap(({ joint }, i) => (values[i] ?? []).map((value) => joints.with(joint, value)));
    const broken = rows.length > 0 ? await examine(rows) : [];
    open.forEach((search, i) =>
      narrow(search, values[i] ?? [], broken.slice(i * SAMPLES, (i + 1) * SAMPLES)),
    );
  }
  return joints.map((_, joint) => {
    const [low, high] = searches.filter((search) => search.joint === joint).map(end);
    const nowhere = { at: joints[joint] ?? 0, limit: null };
    return { low: low ?? nowhere, high: high ?? nowhere };
  });
}

function steps(from: number, to: number): number[] {
  return Array.from({ length: SAMPLES }, (_, i) => from + ((to - from) * (i + 1)) / SAMPLES);
}

function narrow(search: Search, values: number[], broken: (string | null)[]): void {
  const first = broken.findIndex((limit) => limit !== null);
  if (first < 0) {
    search.good = search.far;
    return;
  }
  search.good = values[first - 1] ?? search.good;
  search.far = values[first] ?? search.far;
  search.limit = broken[first] ?? null;
}

function end({ good, limit }: Search): WayEnd {
  return { at: good, limit };
}
