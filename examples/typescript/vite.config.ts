import { defineConfig } from "vite";

export default defineConfig({
  // `await` at the top of a module needs it.
  build: { target: "es2022", chunkSizeWarningLimit: 1000 },
});
