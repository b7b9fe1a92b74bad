/** The workspace and its slice as files. */

import { BASE, type WorkspaceSummary } from "../api/client";
import { view } from "../state/store";

const MESHES = ["glb", "stl", "ply"] as const;
const DRAWINGS = ["dxf", "svg"] as const;

export function Downloads({ found }: { found: WorkspaceSummary }) {
  const { section } = view.value;
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
      {section !== null && (
        <div role="group" aria-label="Download the slice">
          <span>Slice</span>
          {DRAWINGS.map((format) => (
            <a key={format} href={`${BASE}${found.links.self}/slice?z=${section}&format=${format}`} download={`${name}-z${section}.${format}`}>
              {format.toUpperCase()}
            </a>
          ))}
        </div>
      )}
    </div>
  );
}
