/** The symbols of the page, as docs/glossary.md defines them. */

export interface Entry {
  symbol: string;
  name: string;
  meaning: string;
}

export const SYMBOLS: readonly Entry[] = [
  entry("ρ₁", "slider 1", "z of the slider that carries rods 11 and 12; z points down"),
  entry("ρ₂", "slider 2", "z of the slider that carries rods 21 and 22; z points down"),
  entry("ρ₃", "slider 3", "z of the slider that carries rods 31 and 32; z points down"),
  entry("θ₁", "table tilt", "the table tilts by θ₁ about the x axis"),
  entry("θ₂", "table turn", "the table turns by θ₂ about its own axis"),
  entry("P; x, y, z", "platform", "the platform’s reference point in the base frame, mm"),
  entry("α", "platform tilt", "inclination of the platform about the x axis"),
  entry(
    "X, Y, Z",
    "tool tip on the part",
    "the tool’s tip in the part frame, which the table carries; Z points away from it",
  ),
  entry("φ₁", "inclination", "of the tool in the part frame: φ₁ = α − θ₁"),
  entry("φ₂", "azimuth", "of the tool in the part frame: φ₂ = −θ₂"),
  entry("Length", "tool length", "from P to the tool’s tip along the platform’s axis"),
  entry(
    "Radius",
    "tool radius",
    "of the circle that ends the tool; the height over the table is that of its lowest point",
  ),
  entry(
    "Over table",
    "table clearance",
    "least height of the tool’s end and of the platform’s joints over the table",
  ),
  entry("Within", "tolerance", "greatest distance between the mesh and the true boundary, both ways"),
];

/** The words by which solutions are told apart. */
export const MODES: readonly Entry[] = [
  entry(
    "working",
    "",
    "every slider is above its platform joint, leg 1 is not crossed, and the determinant has the same sign as at home: the mode in which the machine runs",
  ),
  entry("leg 2 below", "", "the slider of the leg is below its platform joint"),
  entry("crossed", "", "the two rods of leg 1 cross each other; a real machine cannot get there"),
  entry(
    "other branch",
    "",
    "legs as in the working mode, but the determinant has the other sign: the platform passed a singularity",
  ),
  entry("limit broken", "", "the equations hold, but a joint, a stroke or another limit does not allow it"),
];

/** A tooltip: the symbol’s name and meaning. */
export function tooltip(symbol: string): string | undefined {
  const [found] = SYMBOLS.filter((known) => known.symbol.split(/[,;] /).includes(symbol));
  return found && `${found.name}: ${found.meaning}`;
}

function entry(symbol: string, name: string, meaning: string): Entry {
  return { symbol, name, meaning };
}
