import { defineConfig } from "vitest/config";

export default defineConfig({
  // Relative: the page also works behind a prefix.
  base: "./",
  resolve: {
    // The package of this repository; it brings its own dependencies.
    alias: { "verne-client": new URL("../../clients/typescript/dist/index.js", import.meta.url).pathname },
  },
  build: {
    target: "es2022",
    // Every file under its own name: the page needs no data: addresses.
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 1200,
  },
  server: {
    fs: { allow: ["../.."] },
    // `npm run dev` beside a running service.
    proxy: Object.fromEntries(
      [
        "/fk",
        "/ik",
        "/machines",
        "/workspace",
        "/programs",
        "/toolpath",
        "/jobs",
        "/docs",
        "/openapi.json",
      ].map((path) => [path, "http://127.0.0.1:8080"]),
    ),
  },
  test: { include: ["src/**/*.test.ts"] },
});
