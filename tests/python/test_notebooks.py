"""The notebooks in docs/ run without errors."""
import importlib.util
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
NOTEBOOKS = Path(__file__).resolve().parents[2] / "docs/notebooks"
spec = importlib.util.spec_from_file_location("run", NOTEBOOKS / "run.py")
notebooks = importlib.util.module_from_spec(spec)
spec.loader.exec_module(notebooks)


class Notebooks(unittest.TestCase):
    def test_run_to_their_end(self):
        found = sorted(NOTEBOOKS.glob("*.ipynb"))
        self.assertEqual(len(found), 4)
        for path in found:
            with self.subTest(path.name):
                book = notebooks.run(path)
                self.assertTrue(any(cell.outputs for cell in book.cells if cell.cell_type == "code"))


if __name__ == "__main__":
    unittest.main()
