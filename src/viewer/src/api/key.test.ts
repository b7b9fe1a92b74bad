import { beforeEach, expect, test, vi } from "vitest";
import { send, wanted } from "./key";

const sent: (string | null)[] = [];

beforeEach(() => {
  const kept = new Map<string, string>();
  vi.stubGlobal("sessionStorage", {
    getItem: (name: string) => kept.get(name) ?? null,
    setItem: (name: string, value: string) => kept.set(name, value),
  });
  vi.stubGlobal("fetch", (request: Request) => {
    const key = request.headers.get("authorization");
    sent.push(key);
    return Promise.resolve(new Response(null, { status: key === "Bearer right" ? 200 : 401 }));
  });
  sent.length = 0;
});

const ask = () => send(new Request("http://verne.test/ik", { method: "POST", body: "{}" }));

test("a key is asked for once, and what waited for it goes on", async () => {
  const asked = [ask(), ask()];
  await vi.waitFor(() => expect(wanted.value).not.toBeNull());
  expect(wanted.value?.refused).toBe(false);
  wanted.value?.answer("wrong");
  await vi.waitFor(() => expect(wanted.value?.refused).toBe(true));
  wanted.value?.answer("right");
  expect((await Promise.all(asked)).map(({ status }) => status)).toEqual([200, 200]);
  expect(wanted.value).toBeNull();
  sent.length = 0;
  expect((await ask()).status).toBe(200);
  expect(sent).toEqual(["Bearer right"]);
});

test("who gives none sees what the service says", async () => {
  const asked = ask();
  await vi.waitFor(() => expect(wanted.value).not.toBeNull());
  wanted.value?.answer(null);
  expect((await asked).status).toBe(401);
});
