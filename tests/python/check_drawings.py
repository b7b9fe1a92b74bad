"""Reads DXF files with ezdxf: without complaint, in mm, closed outlines on their layer. python check_drawings.py FILE ..."""

import sys

import ezdxf

for name in sys.argv[1:]:
    drawing = ezdxf.readfile(name)
    audit = drawing.audit()
    if audit.errors or audit.fixes:
        sys.exit(f"{name}: {[entry.message for entry in audit.errors + audit.fixes]}")
    outlines = drawing.modelspace().query('POLYLINE[layer=="OUTER"]')
    if drawing.units != ezdxf.units.MM or not outlines or not all(outline.is_closed for outline in outlines):
        sys.exit(f"{name}: not in mm, or an outline is open")
    print(f"{name}: {len(outlines)} outlines, {len(drawing.modelspace())} polylines")
