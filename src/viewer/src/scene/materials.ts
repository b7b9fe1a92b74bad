/** Surfaces of the machine, one of each, coloured by the palette. */

import {
  CanvasTexture,
  Color,
  DoubleSide,
  LineBasicMaterial,
  MeshBasicMaterial,
  MeshLambertMaterial,
  RepeatWrapping,
  SRGBColorSpace,
} from "three";
import type { Palette } from "./palette";

/** Edges lie on the faces: faces step back a little. */
const FACE = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };

/** As the arrows at the tip, which are three's: equal kinds of materials share a program, and one translated costs time. */
const PLAIN = { transparent: true, fog: false };

export class Materials {
  readonly frame = new MeshLambertMaterial(FACE);
  readonly metal = new MeshLambertMaterial(FACE);
  readonly rod = new MeshLambertMaterial(FACE);
  readonly platform = new MeshLambertMaterial(FACE);
  readonly table = new MeshLambertMaterial(FACE);
  readonly tool = new MeshLambertMaterial(FACE);
  readonly warn = new MeshLambertMaterial(FACE);
  readonly bad = new MeshLambertMaterial(FACE);
  readonly marker = new MeshBasicMaterial({ ...PLAIN, depthTest: false, opacity: 0.9 });
  readonly knob = new MeshBasicMaterial({ ...PLAIN, depthTest: false, opacity: 0.95 });
  readonly guide = new LineBasicMaterial({ ...PLAIN, depthTest: false, opacity: 0.6 });
  readonly edge = new LineBasicMaterial({ ...PLAIN, opacity: 0.45 });
  readonly slot = new LineBasicMaterial(PLAIN);
  readonly grid = new LineBasicMaterial({ ...PLAIN, opacity: 0.55 });
  readonly axisLine = new LineBasicMaterial(PLAIN);
  readonly axisHead = new MeshBasicMaterial(PLAIN);
  readonly cutLine = new LineBasicMaterial({ ...PLAIN, depthTest: false });
  /** Hatched, as drawings show cuts: no colour of a limit looks like it. */
  readonly cutFill = new MeshBasicMaterial({ side: DoubleSide });
  /** A column between the camera and the machine. */
  readonly faded = new MeshLambertMaterial({ transparent: true, opacity: 0.08, depthWrite: false });
  readonly ghost = new MeshLambertMaterial({ transparent: true, opacity: 0.26, depthWrite: false });
  readonly brokenGhost = new MeshLambertMaterial({ transparent: true, opacity: 0.22, depthWrite: false });
  readonly pointedGhost = new MeshLambertMaterial({ transparent: true, opacity: 0.75 });

  paint(palette: Palette): void {
    this.frame.color = palette.frame;
    this.metal.color = palette.metal;
    this.rod.color = palette.rod;
    this.platform.color = palette.platform;
    this.table.color = palette.table;
    this.tool.color = palette.tool;
    this.warn.color = palette.warn;
    this.bad.color = palette.bad;
    this.marker.color = palette.bad;
    this.knob.color = palette.accent;
    this.guide.color = palette.accent;
    this.edge.color = palette.ink;
    this.slot.color = palette.ink;
    this.grid.color = palette.grid;
    this.axisLine.color = palette.ink;
    this.axisHead.color = palette.ink;
    this.cutLine.color = palette["cut-line"];
    this.cutFill.map?.dispose();
    this.cutFill.map = hatch(palette.cut, palette["cut-line"]);
    this.cutFill.needsUpdate = true;
    this.faded.color = palette.frame;
    this.ghost.color = palette.ghost;
    this.brokenGhost.color = palette["broken-ghost"];
    this.pointedGhost.color = palette.accent;
  }
}

/** Distance of the hatch's lines along an edge, mm, and their picture's size, px. */
const HATCH = 45;
const PIXELS = 64;

/** Slanting lines; a shape's texture coordinates are its millimetres. */
function hatch(ground: Color, lines: Color): CanvasTexture {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = PIXELS;
  const context = canvas.getContext("2d");
  if (context) {
    context.fillStyle = `#${ground.getHexString()}`;
    context.fillRect(0, 0, PIXELS, PIXELS);
    context.strokeStyle = `#${lines.getHexString()}`;
    context.lineWidth = 5;
    for (const shift of [-PIXELS, 0, PIXELS]) {
      context.moveTo(shift, PIXELS);
      context.lineTo(shift + PIXELS, 0);
    }
    context.stroke();
  }
  const texture = new CanvasTexture(canvas);
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.repeat.set(1 / HATCH, 1 / HATCH);
  texture.colorSpace = SRGBColorSpace;
  texture.anisotropy = 4;
  return texture;
}
