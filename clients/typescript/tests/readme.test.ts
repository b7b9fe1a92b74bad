/** The snippets of README.md run as they stand there. */

import { readdirSync } from "node:fs";
import { suite, test } from "node:test";
import { serve } from "./service.js";

process.env["VERNE_URL"] = await serve();

const folder = new URL("snippets/", import.meta.url);

suite("the snippets of README.md", () => {
  for (const name of readdirSync(folder).filter((name) => name.endsWith(".js"))) {
    test(name, () => import(new URL(name, folder).href));
  }
});
