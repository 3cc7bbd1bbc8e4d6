"""tools/draw: frames, series and tables are read to the last digit, or refused with their place.

Run with  /usr/bin/python3 -m unittest tests/draw/test_files.py  (Debian's numpy, matplotlib, PIL).
"""
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parent)]

import numpy as np  # noqa: E402

from folder_test import InAFolder  # noqa: E402
from tiny_result import POINTS, TETS, Vtu, fields_at, write_result  # noqa: E402

from draw.errors import DrawError  # noqa: E402
from draw.series import Series  # noqa: E402
from draw.surface import boundary_faces  # noqa: E402
from draw.table import Table  # noqa: E402
from draw.vtu import read_vtu  # noqa: E402


class Reading(InAFolder):
    def read(self, content):
        path = self.folder / "frame.vtu"
        path.write_bytes(content)
        return read_vtu(path)

    def test_every_layout_of_the_arrays_gives_the_exact_values(self):
        node, cell = fields_at(1 / 3)
        for options in ({}, {"index": "i4"}, {"header": "<I"}, {"form": "ascii"}):
            with self.subTest(**options):
                frame = self.read(Vtu(**options).content(node, cell))
                np.testing.assert_array_equal(frame.points, POINTS)
                np.testing.assert_array_equal(frame.tets, TETS)
                for wanted, found in ((node, frame.node_fields), (cell, frame.cell_fields)):
                    self.assertEqual(list(wanted), list(found))
                    for name in wanted:
                        np.testing.assert_array_equal(found[name], wanted[name])

    def test_a_file_cut_off_anywhere_is_damaged_and_says_so(self):
        content = Vtu().content(*fields_at(0))
        data = content.index(b"_", content.index(b"<AppendedData")) + 1
        end = content.index(b"</AppendedData>")
        for size in (0, 20, data // 2, data, data + 7, data + 60, (data + end) // 2, end - 1):
            with self.subTest(size=size), self.assertRaisesRegex(DrawError, "frame.vtu: .*(cut off|not readable)"):
                self.read(content[:size])

    def test_a_wrong_count_of_values_names_the_array(self):
        node, cell = fields_at(0)
        node["velocity"] = node["velocity"][:3]
        with self.assertRaisesRegex(DrawError, "array 'velocity' has 9 values where 5 x 3 belong"):
            self.read(Vtu().content(node, cell))

    def test_other_cells_and_points_out_of_range_are_refused(self):
        with self.assertRaisesRegex(DrawError, r"VTK type \[14\]"):
            self.read(Vtu().content({}, {}, types=14))
        with self.assertRaisesRegex(DrawError, "names point 9, but there are 5"):
            self.read(Vtu(tets=np.array([[0, 1, 2, 9]])).content({}, {}))

    def test_a_quadratic_tet_is_drawn_as_eight_linear_ones(self):
        corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
        edges = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]
        points = np.vstack([corners, [(corners[a] + corners[b]) / 2 for a, b in edges]])
        frame = self.read(Vtu(points, np.arange(10)[None]).content({}, {"region": np.array([[7]], "i4")}, types=24))
        a, b, c, d = (frame.points[frame.tets[:, k]] for k in range(4))
        volumes = np.abs(np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)) / 6
        np.testing.assert_allclose(volumes, 1 / 48)
        self.assertEqual(frame.cell_fields["region"].tolist(), [[7]] * 8)
        faces, _ = boundary_faces(frame.points, frame.tets)
        self.assertEqual(len(faces), 16)  # four for each: none is left between the eight

    def test_frames_are_in_the_order_of_their_times(self):
        series = Series(write_result(self.folder / "r", [0.0, 0.5, 1.0, 4.0]))
        self.assertEqual(series.index_at(0.7), 1)
        self.assertEqual(series.index_at(99), 3)
        self.assertEqual(series.evenly(3), [0, 2, 3])
        self.assertEqual(series.evenly(9), [0, 1, 2, 3])
        self.assertEqual(series.checked_index(-1), 3)

    def test_a_table_has_names_units_and_values(self):
        path = self.folder / "energy.csv"
        path.write_text("t [s], kinetic [J],order\n0,1.5,2\n1,,3\n2,7")
        table = Table(path)
        self.assertEqual([(c.name, c.unit) for c in table.columns.values()],
                         [("t", "s"), ("kinetic", "J"), ("order", "")])
        np.testing.assert_array_equal(table["kinetic"].values, [1.5, np.nan])
        path.write_text("t [s],kinetic [J]\n0,1\n1,x\n2,3\n")
        with self.assertRaisesRegex(DrawError, "energy.csv:3: .*'x'"):
            Table(path)
