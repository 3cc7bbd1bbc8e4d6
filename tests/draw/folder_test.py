"""A test case with its own folder, in which it runs `draw`."""
import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[2] / "tools"
sys.path[:0] = [str(TOOLS)]

from draw.cli import main  # noqa: E402


class InAFolder(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def run_draw(self, *arguments):
        """Exit code, lines on stdout, lines on stderr."""
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main([str(a) for a in arguments])
        return code, out.getvalue().splitlines(), err.getvalue().splitlines()

    def fails_with(self, pattern, *arguments):
        code, _, err = self.run_draw(*arguments)
        self.assertEqual((code, len(err)), (2, 1), err)
        self.assertRegex(err[0], pattern)
