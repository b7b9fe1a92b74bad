// The built binary as a service of its own. VERNE names the binary.
import { spawn } from "node:child_process";
import { resolve } from "node:path";
import { createInterface } from "node:readline";

export const VERNE = resolve(import.meta.dirname, process.env.VERNE ?? "../../target/debug/verne");

/** Starts a service on a free port that keeps its results in memory. Answers its address, and how to stop it. */
export async function serve(...options) {
  const service = spawn(VERNE, ["serve", "--memory-only", "--listen", "127.0.0.1:0", ...options]);
  process.once("exit", () => service.kill());
  const address = await new Promise((found, failed) => {
    for (const stream of [service.stdout, service.stderr])
      createInterface({ input: stream }).on("line", (line) => {
        const [address] = /http:\/\/127\.0\.0\.1:\d+/.exec(line) ?? [];
        if (address) found(address);
      });
    service.once("error", failed);
    service.once("exit", (code) => failed(new Error(`verne serve has ended with ${code}`)));
  });
  return { address, stop: () => service.kill() };
}
