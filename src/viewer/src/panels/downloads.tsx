/** The workspace and its slice as files. */

import { BASE, type WorkspaceSummary } from "../api/client";
import { section } from "../state/store";

const MESHES = ["glb", "stl", "ply"] as const;
const DRAWINGS = ["dxf", "svg"] as const;

export function Downloads({ found }: { found: WorkspaceSummary }) {
  const z = section.value;
  const name = `${found.machine.name}-${found.kind}`;
  return (
    <div class="downloads">
      <div role="group" aria-label="Download the mesh">
        <span>Mesh</span>
        {MESHES.map((format) => (
          <a key={format} href={`${BASE}${found.links.mesh}?format=${format}`} download={`${name}.${format}`}>
            {format.toUpperCase()}
          </a>
        ))}
      </div>
      {z !== null && (
        <div role="group" aria-label="Download the slice">
          <span>Slice</span>
          {DRAWINGS.map((format) => (
            <a
              key={format}
              href={`${BASE}${found.links.self}/slice?z=${z}&format=${format}`}
              download={`${name}-z${z}.${format}`}
            >
              {format.toUpperCase()}
            </a>
          ))}
        </div>
      )}
    </div>
  );
}
