/** Problem documents (RFC 9457) as errors. */

import type { Problem } from "./schemas.js";

/** A request that the service, or a proxy before it, did not fulfil. */
export class ProblemError extends Error {
  override readonly name = "ProblemError";

  constructor(
    /** The status of the answer; of a job that failed, the status that its problem states. */
    readonly status: number,
    detail: string,
    /** The problem document; null if the answer had none, such as that of a proxy. */
    readonly problem: Problem | null,
  ) {
    super(detail);
  }

  /** The error of a problem document. */
  static of(problem: Problem): ProblemError {
    return new ProblemError(problem.status, problem.detail, problem);
  }

  /** The stable name of the problem. */
  get code(): Problem["code"] | null {
    return this.problem?.code ?? null;
  }

  /** The invalid fields, each with its JSON Pointer, or the faults of a program. */
  get errors(): NonNullable<Problem["errors"]> {
    return this.problem?.errors ?? [];
  }
}

/** The error of an answer whose body was read. */
export function problemOf(body: unknown, response: Response): ProblemError {
  if (typeof body === "object" && body !== null && "code" in body && "detail" in body) {
    return new ProblemError(response.status, String(body.detail), body as Problem);
  }
  return new ProblemError(
    response.status,
    `The service answered ${response.status} ${response.statusText}.`,
    null,
  );
}

/** The error of an answer whose body was not read. */
export async function readProblem(response: Response): Promise<ProblemError> {
  return problemOf(await response.json().catch(() => null), response);
}

/** The data of an answer; its problem is thrown. */
export function unwrap<T>(answer: { data?: T; error?: unknown; response: Response }): T {
  if (answer.response.ok && answer.data !== undefined) return answer.data;
  throw problemOf(answer.error, answer.response);
}
