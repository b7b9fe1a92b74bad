// Debian's Chromium (or the one that CHROMIUM names), drawing in software, asking nobody else.
import { execFileSync } from "node:child_process";

const chromium = execFileSync("sh", ["-c", 'command -v "${CHROMIUM:-chromium}"'], {
  encoding: "utf8",
}).trim();

export const LAUNCH = {
  executablePath: chromium,
  args: [
    "--no-sandbox",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
  ],
};
