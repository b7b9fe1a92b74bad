"""Reads DXF files with ezdxf: without a complaint, in mm, with the extents of what they hold, and closed outlines. Slices
have layers of their own and a text for each line of constant alpha, atlases a layer for each number of solutions."""

import argparse
import sys

import ezdxf
from ezdxf import bbox, recover

LAYERS = {"0", "OUTER", "HOLES", "ALPHA"}


def faults(name):
    """What is wrong with a drawing, as lines of text."""
    # What the plain reader repairs in silence, the recovering one reports.
    for drawing, audit in [((plain := ezdxf.readfile(name)), plain.audit()), recover.readfile(name)]:
        yield from (entry.message for entry in audit.errors + audit.fixes)
    header = drawing.header
    if (drawing.dxfversion, drawing.units, header["$MEASUREMENT"]) != ("AC1015", ezdxf.units.MM, 1):
        yield f"is {drawing.dxfversion} in units {drawing.units}, measurement {header['$MEASUREMENT']}"
    layers = {layer.dxf.name for layer in drawing.layers}
    numbers = {layer.removeprefix("SOLUTIONS_") for layer in layers if layer.startswith("SOLUTIONS_")}
    if not LAYERS <= layers and not numbers:
        yield f"has the layers {layers}"
    model = drawing.modelspace()
    outlines = model.query('LWPOLYLINE[layer ? "OUTER|SOLUTIONS_.*"]')
    if not outlines or not all(outline.closed for outline in outlines):
        yield "has no outline, or an open one"
    held = bbox.extents(outlines)
    for found, wanted in ((header["$EXTMIN"], held.extmin), (header["$EXTMAX"], held.extmax)):
        if not wanted.isclose(found, abs_tol=1e-6):
            yield f"has an extent of {found} instead of {wanted}"
    shown = {text.plain_text() for text in model.query('TEXT[layer ? "SOLUTIONS_.*"]')}
    if not shown <= numbers or numbers and not shown:
        yield f"has the numbers {shown} on layers of {numbers}"
    lines, texts = model.query('LWPOLYLINE[layer=="ALPHA"]'), model.query('TEXT[layer=="ALPHA"]')
    values = [text.plain_text() for text in texts]
    if len(lines) != len(values) or not all(-180 <= float(value.removesuffix("°")) <= 180 for value in values):
        yield f"has {len(lines)} lines of constant alpha and the texts {values}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+")
    failed = False
    for name in parser.parse_args().files:
        found = list(faults(name))
        print(f"{name}: {'; '.join(found) or 'as it should be'}")
        failed = failed or bool(found)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
