/** The page: the scene in the middle, what moves it to the left, what is known to the right. */

import { useEffect, useRef, useState } from "preact/hooks";
import { position } from "../state/store";
import { drawing } from "../scene/software";
import type { Side } from "../scene/viewpoint";
import { World } from "../scene/world";
import { About } from "./about";
import { CopyMenu } from "./copy_menu";
import { Help } from "./help";
import { JointsPanel } from "./joints";
import { KeyDialog } from "./key";
import { MachinePicker } from "./machine";
import { MachineForm } from "./machine_form";
import { MachineFaults } from "./machine_faults";
import { acceptDrops, offer } from "./machine_file";
import { MarginsPanel } from "./margins";
import { MeasurementCaption } from "./measurement_caption";
import { Notices } from "./notices";
import { AtlasSection } from "../atlas/entry";
import { DexterityCaption, DexteritySection, showLayersIn } from "../dexterity/entry";
import { ErrorsSection, showErrorsIn } from "../errors/entry";
import { FamilySection } from "../families/entry";
import { openProgramFile, ProgramDialogs, ProgramDock, ProgramSection, showPathIn } from "../program/entry";
import { PositionsPanel } from "./positions";
import { SceneTools } from "./scene_tools";
import { ToolPanel } from "./tool";
import { ToolTipPanel } from "./tool_tip";
import { WorkspaceCaption } from "./workspace_caption";
import { WorkspacePanel } from "./workspace";

const SIDES: [Side, string][] = [
  ["whole", "Whole"],
  ["front", "Front"],
  ["side", "Side"],
  ["top", "Top"],
];

export function Page() {
  const [dropping, setDropping] = useState(false);
  useEffect(() => acceptDrops(setDropping, take), []);
  return (
    <>
      <header class="top">
        <h1>verne</h1>
        <MachinePicker />
        <nav aria-label="Elsewhere">
          <CopyMenu />
          <Help />
          <About />
          <a class="button" href="docs/">
            API
          </a>
        </nav>
      </header>
      <main>
        <div class="panel left">
          <JointsPanel />
          <ToolPanel />
          <ToolTipPanel />
          <PositionsPanel />
          <MachineForm />
        </div>
        <Scene />
        <div class="panel right">
          <ProgramSection />
          <MarginsPanel />
          <WorkspacePanel />
          <FamilySection />
          <DexteritySection />
          <ErrorsSection />
          <AtlasSection />
        </div>
        <ProgramDock />
      </main>
      {dropping && (
        <div class="dropping" aria-hidden="true">
          Drop a program, or a machine’s JSON file
        </div>
      )}
      <MachineFaults />
      <ProgramDialogs />
      <KeyDialog />
    </>
  );
}

/** A machine is a JSON file; every other file is taken for a program. */
function take(file: File): void {
  void (/\.json$/i.test(file.name) ? offer(file) : openProgramFile(file));
}

function Scene() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const labels = useRef<HTMLDivElement>(null);
  const [world, setWorld] = useState<World | null>(null);
  const [trouble, setTrouble] = useState<string | null>(null);
  useEffect(() => {
    if (!canvas.current || !labels.current) return;
    const kind = drawing();
    if (kind !== "none") {
      const made = new World(canvas.current, labels.current, kind);
      showPathIn(made.stage);
      showLayersIn(made.stage);
      showErrorsIn(made.stage);
      setWorld(made);
    } else setTrouble("This browser draws no 3D (WebGL 2): the figures beside remain.");
  }, []);
  return (
    <section class="scene" aria-label="The machine in its workspace">
      <canvas
        ref={canvas}
        tabIndex={0}
        role="img"
        data-ready={position.value ? "yes" : "no"}
        aria-label="The machine in 3D. Drag to turn, wheel to come nearer; arrow keys move, with shift they turn."
      />
      <div ref={labels} class="labels" aria-hidden="true" />
      <div class="over">
        <WorkspaceCaption />
        <DexterityCaption />
        <MeasurementCaption />
        <Notices />
      </div>
      <div class="below">
        <SceneTools world={world} />
        <div role="group" aria-label="Look from">
          {SIDES.map(([side, name]) => (
            <button type="button" key={side} onClick={() => world?.viewpoint.from(side)}>
              {name}
            </button>
          ))}
        </div>
      </div>
      {trouble && <p class="trouble">{trouble}</p>}
    </section>
  );
}
