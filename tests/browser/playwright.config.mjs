// The viewer of the built binary, in Chromium. VERNE names the binary; VERNE_ADDRESS a service that runs already.
import { defineConfig } from "@playwright/test";
import { LAUNCH } from "./launch.mjs";

const address = "127.0.0.1:18473";
const verne = process.env.VERNE ?? "../../target/debug/verne";

export default defineConfig({
  testDir: ".",
  testMatch: "*.spec.mjs",
  outputDir: "../../target/browser-tests",
  workers: 1,
  // Software rendering on a busy machine is slow; what is waited for is a state, not a time.
  timeout: 120_000,
  expect: { timeout: 30_000 },
  reporter: "list",
  use: {
    baseURL: process.env.VERNE_ADDRESS ?? `http://${address}`,
    launchOptions: LAUNCH,
    viewport: { width: 1280, height: 720 },
    trace: "retain-on-failure",
  },
  webServer: process.env.VERNE_ADDRESS
    ? undefined
    : {
        command: `${verne} serve --memory-only --listen ${address}`,
        url: `http://${address}/readyz`,
        reuseExistingServer: false,
      },
});
