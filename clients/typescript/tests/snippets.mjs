// Writes the snippets of README.md to tests/snippets, where they are compiled and run as tests.

import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";

const folder = new URL("snippets/", import.meta.url);
rmSync(folder, { recursive: true, force: true });
mkdirSync(folder);
const readme = readFileSync(new URL("../README.md", import.meta.url), "utf8");
const snippets = [...readme.matchAll(/^```ts\n(.*?)^```$/gms)];
if (snippets.length === 0) throw new Error("README.md has no snippets.");
snippets.forEach(([, text], number) => {
  const asked = text.replaceAll('"http://127.0.0.1:8080"', 'process.env["VERNE_URL"]!');
  writeFileSync(new URL(`snippet-${number + 1}.ts`, folder), asked);
});
