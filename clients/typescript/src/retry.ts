/** Repeats requests when the service says so. */

/** Sends a request. */
export type Send = (request: Request) => Promise<Response>;

/** Statuses of requests that the service has not begun: too many requests, and overload. */
const POSTPONED = [429, 503];

/**
 * Repeats a request that was answered with Retry-After, after that time.
 *
 * @param attempts How often a request is sent at most.
 */
export function retrying(send: Send, attempts: number): Send {
  return async (request) => {
    for (let left = attempts - 1; ; left -= 1) {
      // A body can be sent once.
      const answer = await send(left > 0 ? request.clone() : request);
      const wait = POSTPONED.includes(answer.status) ? milliseconds(answer.headers.get("retry-after")) : null;
      if (left <= 0 || wait === null) return answer;
      await answer.body?.cancel();
      await pause(wait, request.signal);
    }
  };
}

/** The time of Retry-After from now, which is a number of seconds or a date. */
function milliseconds(retryAfter: string | null): number | null {
  if (retryAfter === null) return null;
  const wait = /^\d+$/.test(retryAfter) ? Number(retryAfter) * 1000 : Date.parse(retryAfter) - Date.now();
  return Number.isNaN(wait) ? null : Math.max(0, wait);
}

function pause(wait: number, signal: AbortSignal): Promise<void> {
  return new Promise((resolve, reject) => {
    signal.throwIfAborted();
    const abort = () => {
      clearTimeout(timer);
      reject(signal.reason as Error);
    };
    const timer = setTimeout(() => {
      signal.removeEventListener("abort", abort);
      resolve();
    }, wait);
    signal.addEventListener("abort", abort, { once: true });
  });
}
