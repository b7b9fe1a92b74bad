/** The workspace and its slice as files. */

import type { WorkspaceSummary } from "verne-client";
import { failureOf, verne } from "../api/client";
import { hasKey } from "../api/key";
import { failure, section } from "../state/store";
import { saveFile } from "./save_file";

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
          <File key={format} link={`${found.links.mesh}.${format}`} name={`${name}.${format}`}>
            {format.toUpperCase()}
          </File>
        ))}
      </div>
      {z !== null && (
        <div role="group" aria-label="Download the slice">
          <span>Slice</span>
          {DRAWINGS.map((format) => (
            <File
              key={format}
              link={`${found.links.self}/slice.${format}?z=${z}`}
              name={`${name}-z${z}.${format}`}
            >
              {format.toUpperCase()}
            </File>
          ))}
        </div>
      )}
    </div>
  );
}

export function File({ link, name, children }: { link: string; name: string; children: string }) {
  // A link sends no key: where there is one, the file is fetched and saved from here.
  const saveWithKey = (event: MouseEvent) => {
    if (!hasKey()) return;
    event.preventDefault();
    void saveOrTell(link, name);
  };
  return (
    <a href={verne.address(link)} download={name} onClick={saveWithKey}>
      {children}
    </a>
  );
}

async function saveOrTell(link: string, name: string): Promise<void> {
  try {
    await save(link, name);
  } catch (thrown) {
    failure.value = failureOf(thrown, () => void saveOrTell(link, name));
  }
}

async function save(file: string, name: string): Promise<void> {
  saveFile(new Blob([await verne.file(file)]), name);
}
