/** The joint program, the rows, the report and the path as files. */

import type { ToolpathReport } from "verne-client";
import { File } from "../panels/downloads";
import type { OpenProgram } from "./program_state";

export function ProgramDownloads({ open, report }: { open: OpenProgram; report: ToolpathReport }) {
  const name = open.name.replace(/\.[^.]+$/, "");
  const { links } = report;
  return (
    <div class="downloads">
      <div role="group" aria-label="Download the joint motion">
        <span>Joints</span>
        {links.program && (
          <File link={links.program} name={`${name}-joints.ngc`}>
            G-code
          </File>
        )}
        <File link={`${links.rows}.csv`} name={`${name}-joints.csv`}>
          CSV
        </File>
        <File link={`${links.rows}.arrow`} name={`${name}-joints.arrow`}>
          Arrow
        </File>
      </div>
      <div role="group" aria-label="Download the report and the path">
        <span>Other</span>
        <File link={links.self} name={`${name}-report.json`}>
          Report
        </File>
        <File link={links.path} name={`${name}-path.glb`}>
          Path (GLB)
        </File>
      </div>
      {!links.program && (
        <p class="hint">There is a joint program as G-code when the machine can run the program.</p>
      )}
    </div>
  );
}
