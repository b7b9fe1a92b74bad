/** The machine where it stands now: its bodies, the frames with their names, and the part that is near a limit. */

import { effect } from "@preact/signals";
import { Group, OrthographicCamera, Vector3 } from "three";
import { baseFromTable } from "../geometry/frames";
import { machine, position, tool, type InUse } from "../state/store";
import { bars } from "../words/margins";
import type { Materials } from "./materials";
import { Mechanism, sliderPlace, unitOf } from "./mechanism";
import type { Stage } from "./stage";
import { Surroundings } from "./surroundings";
import { label, Triad } from "./triads";

/** A margin of less than this part of its range is shown on the machine. */
const NEAR = 0.05;

interface Bodies {
  of: InUse;
  mechanism: Mechanism;
  surroundings: Surroundings;
}

export class MachineView {
  /** In the base frame, mm. */
  readonly group = new Group();
  private readonly bodies = new Group();
  private readonly baseTriad: Triad;
  private readonly partTriad: Triad;
  private built: Bodies | null = null;

  constructor(
    private readonly stage: Stage,
    private readonly materials: Materials,
  ) {
    this.baseTriad = new Triad(["x", "y", "z down"], [260, 260, 260], materials);
    this.partTriad = new Triad(["X", "Y", "Z up"], [390, 390, 220], materials);
    this.partTriad.group.matrixAutoUpdate = false;
    this.group.add(this.bodies, this.baseTriad.group, this.partTriad.group);
    effect(() => this.follow());
  }

  /** Without perspective, what stands between the camera and the machine is seen through. */
  clear(): void {
    const { camera } = this.stage;
    const towards = camera.getWorldDirection(new Vector3()).negate();
    const inBase = new Vector3(towards.x, towards.z, -towards.y);
    this.built?.surroundings.clear(camera instanceof OrthographicCamera ? inBase : null);
  }

  private follow(): void {
    const found = machine.value;
    if (found && found !== this.built?.of) this.built = this.build(found);
    if (this.built) this.place(this.built);
    this.stage.draw();
  }

  private build(found: InUse): Bodies {
    const { definition } = found;
    const mechanism = new Mechanism(definition.geometry, this.materials);
    const surroundings = new Surroundings(definition, this.materials);
    const unit = unitOf(definition.geometry);
    for (const triad of [this.baseTriad, this.partTriad]) triad.group.scale.setScalar(unit);
    this.bodies.clear();
    this.bodies.add(mechanism.group, surroundings.group, ...sliderLabels(found));
    return { of: found, mechanism, surroundings };
  }

  private place({ of: { definition, home }, mechanism, surroundings }: Bodies): void {
    const at = position.value;
    if (!at) return;
    mechanism.place(at.joints.rho, at.solution.platform, tool.value);
    const worst = bars(at.solution.margins, definition, home)[0];
    const near = worst && worst.part < NEAR ? worst : null;
    mechanism.mark(near, near && near.part < 0 ? this.materials.bad : this.materials.warn);
    surroundings.turn(at.joints);
    // The scale stays in the matrix: the triad is not updated by itself.
    const { group } = this.partTriad;
    group.matrix.copy(baseFromTable(definition.table, at.joints)).scale(group.scale);
    group.matrixWorldNeedsUpdate = true;
  }
}

function sliderLabels({ definition }: InUse) {
  const { geometry: g, limits } = definition;
  return ([0, 1, 2] as const).map((leg, i) => {
    const text = label(`slider ${i + 1}`, "slider");
    text.position.copy(sliderPlace(g, leg)).setZ((limits.stroke[i]?.[0] ?? 0) - 110 * unitOf(g));
    return text;
  });
}
