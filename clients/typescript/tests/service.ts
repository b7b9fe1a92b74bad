/** A service of the binary that VERNE names, for the tests. */

import { spawn } from "node:child_process";
import { createServer } from "node:net";
import { after } from "node:test";

/** Starts a service, which ends after the tests of the file. Returns its address. */
export async function serve(...flags: string[]): Promise<string> {
  const binary = process.env["VERNE"];
  if (binary === undefined) throw new Error("VERNE must be the path of the verne binary.");
  const port = await freePort();
  const address = `127.0.0.1:${port}`;
  const child = spawn(binary, ["serve", "--listen", address, "--memory-only", ...flags], { stdio: "ignore" });
  const exited = new Promise<never>((_, reject) => {
    child.once("error", reject);
    child.once("exit", (status) => reject(new Error(`verne ended with ${status}.`)));
  });
  after(() => {
    exited.catch(() => undefined);
    child.kill();
  });
  await Promise.race([ready(`http://${address}`), exited]);
  return `http://${address}`;
}

async function freePort(): Promise<number> {
  const server = createServer();
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
  const { port } = server.address() as { port: number };
  await new Promise((resolve) => server.close(resolve));
  return port;
}

async function ready(base: string): Promise<void> {
  for (;;) {
    const answer = await fetch(`${base}/readyz`).catch(() => null);
    if (answer?.ok) return;
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
}
