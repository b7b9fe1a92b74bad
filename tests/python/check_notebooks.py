#!/usr/bin/env python3
"""Runs the notebooks in examples/python against a service of their own.

    VERNE=target/debug/verne check_notebooks.py [--write]

A cell that raises an error fails. Each picture must have several colours. With --write the notebooks keep what they print
and draw.
"""

import argparse
import base64
import io
import sys
from pathlib import Path

import matplotlib.image
import nbformat
import numpy
from nbclient import NotebookClient

EXAMPLES = Path(__file__).parents[2] / "examples/python"
SECONDS = 300
WIDGET = "application/vnd.jupyter.widget-view+json"


def pictures(notebook):
    """The pictures that the notebook draws, as arrays of colours."""
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            if picture := output.get("data", {}).get("image/png"):
                yield matplotlib.image.imread(io.BytesIO(base64.b64decode(picture)))


def remove_bars(notebook):
    """Removes what changes from run to run: times and bars."""
    notebook.metadata.pop("widgets", None)
    for cell in notebook.cells:
        cell.metadata.pop("execution", None)
        if cell.cell_type == "code":
            cell.outputs = [output for output in cell.outputs if WIDGET not in output.get("data", {})]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true", help="store the outputs in the notebooks")
    options = parser.parse_args()
    faults = 0
    for path in sorted(EXAMPLES.glob("*.ipynb")):
        notebook = nbformat.read(path, as_version=4)
        NotebookClient(notebook, timeout=SECONDS, resources={"metadata": {"path": path.parent}}).execute()
        drawn = list(pictures(notebook))
        blank = [i for i, picture in enumerate(drawn) if len(numpy.unique(picture.reshape(-1, 4), axis=0)) < 10]
        faults += len(blank)
        print(f"{path.name}: {len(notebook.cells)} cells, {len(drawn)} pictures, {len(blank)} blank")
        if options.write:
            remove_bars(notebook)
            nbformat.write(notebook, path)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
