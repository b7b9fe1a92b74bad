"""Makes a job in a real FreeCAD and posts it: freecadcmd freecad_job.py

A block is faced and its outline is milled. The environment names the service (VERNE_SERVER), the arguments of the
post-processor (VERNE_ARGUMENTS) and the file to write (VERNE_OUTPUT). Prints `posted` or the error.
"""

import os
import pathlib
import sys
import traceback

import FreeCAD
import Part

sys.path.append(str(pathlib.Path(os.environ["VERNE_EXAMPLES"]) / "freecad"))
import verne_post  # noqa: E402

try:
    # FreeCAD 1.0 and later.
    import Path.Main.Job as job_module
    import Path.Op.MillFace as face_module
    import Path.Op.Profile as profile_module
except ImportError:
    import PathScripts.PathJob as job_module
    import PathScripts.PathMillFace as face_module
    import PathScripts.PathProfile as profile_module


def make():
    """The tool controller and the operations of a job for a block of 80 x 60 x 20 mm around the origin."""
    document = FreeCAD.newDocument("block")
    block = document.addObject("Part::Feature", "Block")
    block.Shape = Part.makeBox(80, 60, 20, FreeCAD.Vector(-40, -30, 0))
    document.recompute()
    job = job_module.Create("Job", [block])
    controller = job.Tools.Group[0]
    controller.HorizFeed, controller.VertFeed = "900 mm/min", "300 mm/min"
    operations = [module.Create(name) for module, name in ((face_module, "Face"), (profile_module, "Outline"))]
    for operation in operations:
        job.Proxy.addOperation(operation) if operation not in job.Operations.Group else None
        operation.ToolController = controller
    document.recompute()
    return [controller, *operations]


def main():
    objects = make()
    print("commands:", [(item.Label, len(item.Path.Commands)) for item in objects])
    verne_post.export(
        objects,
        os.environ["VERNE_OUTPUT"],
        f"--server {os.environ['VERNE_SERVER']} {os.environ['VERNE_ARGUMENTS']}",
    )
    print("posted")


try:
    main()
except Exception:
    traceback.print_exc(file=sys.stdout)
