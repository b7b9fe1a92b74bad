// The Khronos validator on each GLB named: node validate.mjs FILE.glb ...
// Ends with 1 if any has an error, a warning or an information to give: our files should leave nothing to say.
import { readFile } from "node:fs/promises";
import { validateBytes } from "gltf-validator";

const files = process.argv.slice(2);
if (files.length === 0) {
  console.error("usage: node validate.mjs FILE.glb ...");
  process.exit(2);
}

let failed = false;
for (const file of files) {
  const report = await validateBytes(new Uint8Array(await readFile(file)), { uri: file, maxIssues: 20 });
  const { numErrors, numWarnings, numInfos, numHints, messages } = report.issues;
  const { totalVertexCount, totalTriangleCount } = report.info;
  console.log(
    `${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos, ${numHints} hints; ` +
      `${totalVertexCount} vertices, ${totalTriangleCount} triangles`,
  );
  for (const { code, message, pointer } of messages) console.log(`  ${code} ${pointer ?? ""}: ${message}`);
  failed ||= numErrors + numWarnings + numInfos > 0;
}
process.exit(failed ? 1 : 0);
