// The viewer of the built binary, in Chromium; see service.mjs.
import { defineConfig } from "@playwright/test";
import { LAUNCH } from "./launch.mjs";

export default defineConfig({
  testDir: ".",
  testMatch: "*.spec.mjs",
  outputDir: "../../target/browser-tests",
  // Much of a test is waiting: for answers, and for a hand that rests.
  workers: 2,
  // Software rendering on a busy machine is slow; what is waited for is a state, not a time.
  timeout: 240_000,
  expect: { timeout: 60_000 },
  reporter: "list",
  use: {
    launchOptions: LAUNCH,
    viewport: { width: 1280, height: 720 },
    trace: "retain-on-failure",
  },
});
