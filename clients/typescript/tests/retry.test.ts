/** Requests that the service postpones. */

import assert from "node:assert/strict";
import { suite, test } from "node:test";
import { ProblemError, unwrap, Verne } from "verne-client";

/** Answers with these statuses, one for each request, and keeps the bodies and keys. */
function answering(statuses: number[], retryAfter: string | null) {
  const sent: [string, string | null][] = [];
  const fetch = async (request: Request) => {
    sent.push([await request.text(), request.headers.get("authorization")]);
    const status = statuses[sent.length - 1] ?? 200;
    const headers = { "content-type": "application/json", ...(retryAfter && { "retry-after": retryAfter }) };
    return new Response(status === 200 ? '{"solutions":[]}' : '{"code":"queue_full","detail":"Full."}', {
      status,
      headers,
    });
  };
  return { fetch, sent };
}

const body = { joints: { rho: [600, 500, 500] } };

suite("a request that the service postpones", () => {
  test("is sent again with its body and its key", async () => {
    for (const retryAfter of ["0", new Date(0).toUTCString()]) {
      const { fetch, sent } = answering([503, 429, 200], retryAfter);
      const verne = new Verne("http://verne.test", { fetch, key: "k" });
      unwrap(await verne.api.POST("/fk", { body }));
      assert.deepEqual(sent, Array(3).fill([JSON.stringify(body), "Bearer k"]));
    }
  });

  test("fails after the last attempt, and at once without Retry-After", async () => {
    for (const [retryAfter, attempts] of [
      ["0", 2],
      [null, 1],
    ] as const) {
      const { fetch, sent } = answering([503, 503, 503], retryAfter);
      const verne = new Verne("http://verne.test", { fetch, attempts: 2 });
      const answer = await verne.api.POST("/fk", { body });
      assert.throws(
        () => unwrap(answer),
        (error) => error instanceof ProblemError && error.code === "queue_full",
      );
      assert.equal(sent.length, attempts);
    }
  });

  test("is not sent again if its signal is aborted", async () => {
    const abort = new AbortController();
    const { fetch, sent } = answering([503], "3600");
    const verne = new Verne("http://verne.test", { fetch });
    const answer = verne.api.POST("/fk", { body, signal: abort.signal });
    abort.abort();
    await assert.rejects(answer, { name: "AbortError" });
    assert.ok(sent.length <= 1);
  });
});

suite("an answer without a problem document", () => {
  test("is an error with its status", async () => {
    const bad = new Response("<h1>Bad gateway</h1>", { status: 502, statusText: "Bad Gateway" });
    const fetch = () => Promise.resolve(bad);
    const verne = new Verne("http://verne.test", { fetch });
    await assert.rejects(verne.file("/workspace/1/mesh.glb"), { status: 502, code: null, errors: [] });
  });
});

suite("a link of the service", () => {
  test("is found with and without a prefix", () => {
    for (const [base, link, address] of [
      ["http://verne.test:8080", "/jobs/1", "http://verne.test:8080/jobs/1"],
      // The service knows the prefix, or only the proxy does.
      ["https://cam.test/verne/", "/verne/jobs/1", "https://cam.test/verne/jobs/1"],
      ["https://cam.test/verne", "/jobs/1", "https://cam.test/verne/jobs/1"],
    ] as const) {
      assert.equal(new Verne(base).address(link), address);
    }
  });
});
