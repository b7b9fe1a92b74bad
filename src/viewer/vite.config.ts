import type { Plugin } from "vite";
import { defineConfig } from "vitest/config";

/** What the viewer draws with: programs of three, and a part that three adds to each of them. */
const SHADERS = [
  ...["meshbasic", "meshlambert", "linedashed", "points"].flatMap((name) => [`${name}_vert`, `${name}_frag`]),
  "colorspace_pars_fragment",
];

/** Leaves out the texts of three's other programs, a tenth of the bundle: three keeps all of them in one object. */
function otherShadersLeftOut(): Plugin {
  return {
    name: "other-shaders-left-out",
    transform(code, id) {
      if (!id.endsWith("/three/build/three.module.js")) return null;
      const text = /^(?:const|var) ([\w$]+) = ("(?:[^"\\]|\\.)*");$/gm;
      const texts = new Map([...code.matchAll(text)].map(([, variable, glsl]) => [variable, glsl]));
      // Entries of the object are `name` or `name: variable`.
      const [, entries = ""] = /^const ShaderChunk = \{([^}]*)\};$/m.exec(code) ?? [];
      const left = new Map(
        [...entries.matchAll(/(\w+)(?:: ([\w$]+))?/g)].map(([, name, as]) => [name, as ?? name]),
      );
      const keep = (name: string) => {
        const variable = left.get(name);
        left.delete(name);
        for (const [, part = ""] of texts.get(variable)?.matchAll(/#include +<(\w+)>/g) ?? []) keep(part);
      };
      for (const name of SHADERS) if (!left.has(name)) this.error(`three has no shader ${name}`);
      SHADERS.forEach(keep);
      const others = new Set(left.values());
      return {
        code: code.replace(text, (whole, variable: string) =>
          others.has(variable) ? `var ${variable} = "";` : whole,
        ),
        map: null,
      };
    },
  };
}

export default defineConfig({
  // Relative: the page also works behind a prefix.
  base: "./",
  plugins: [otherShadersLeftOut()],
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
