import { expect, test } from "vitest";
import { linked } from "./links";

test("links lead to the service with or without a prefix", () => {
  for (const [base, link, address] of [
    ["http://verne.test:8080", "/jobs/1", "http://verne.test:8080/jobs/1"],
    // The service knows the prefix, or only the proxy does.
    ["https://cam.test/verne", "/verne/jobs/1", "https://cam.test/verne/jobs/1"],
    ["https://cam.test/verne", "/jobs/1", "https://cam.test/verne/jobs/1"],
  ] as const) {
    expect(linked(base, link)).toBe(address);
  }
});
