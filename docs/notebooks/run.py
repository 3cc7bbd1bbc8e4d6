"""Runs the notebooks of this folder, each in a temporary folder:  python3 run.py [--save] [NAME...]

--save stores the outputs in the notebooks. Needs nbclient, ipykernel and an importable orthodyn.
"""
import argparse
import sys
import tempfile
from pathlib import Path

import nbformat
from nbclient import NotebookClient

HERE = Path(__file__).resolve().parent
SECONDS = 300
KEPT = 300_000  # characters of an output: a view in 3D is larger


def run(path, save=False):
    """Raises CellExecutionError if a cell fails."""
    book = nbformat.read(path, 4)
    with tempfile.TemporaryDirectory() as folder:
        NotebookClient(book, timeout=SECONDS, kernel_name="python3", resources={"metadata": {"path": folder}}).execute()
    if save:
        nbformat.write(slim(book), path)
    return book


def slim(book):
    """Removes execution times, progress messages, and outputs longer than KEPT characters."""
    for cell in book.cells:
        cell.metadata.pop("execution", None)
        if cell.cell_type == "code":
            cell.outputs = [o for o in cell.outputs if o.get("name") != "stderr"
                            and len(str(o.get("data", o.get("text", "")))) <= KEPT]
    return book


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="default: all")
    parser.add_argument("--save", action="store_true")
    given = parser.parse_args()
    for path in sorted(HERE.glob("*.ipynb")):
        if not given.names or path.stem in given.names:
            run(path, given.save)
            print(path.name, file=sys.stderr)


if __name__ == "__main__":
    main()
