/** The workspace and its slice as files. */

import { address, inWords, Refused, type WorkspaceSummary } from "../api/client";
import { hasKey, send } from "../api/key";
import { failure, section } from "../state/store";

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
          <a
            key={format}
            href={`${address(found.links.mesh)}?format=${format}`}
            download={`${name}.${format}`}
            onClick={saveWithKey}
          >
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
              href={`${address(found.links.self)}/slice?z=${z}&format=${format}`}
              download={`${name}-z${z}.${format}`}
              onClick={saveWithKey}
            >
              {format.toUpperCase()}
            </a>
          ))}
        </div>
      )}
    </div>
  );
}

/** A link sends no key: where there is one, the file is fetched and saved from here. */
function saveWithKey(event: MouseEvent): void {
  const link = event.currentTarget;
  if (!hasKey() || !(link instanceof HTMLAnchorElement)) return;
  event.preventDefault();
  save(link.href, link.download).catch((thrown: unknown) => (failure.value = inWords(thrown)));
}

async function save(href: string, name: string): Promise<void> {
  const answer = await send(new Request(href));
  if (!answer.ok) throw new Refused({ detail: `The file cannot be had: ${answer.status}.` });
  const link = document.createElement("a");
  link.href = URL.createObjectURL(await answer.blob());
  link.download = name;
  link.click();
  URL.revokeObjectURL(link.href);
}
