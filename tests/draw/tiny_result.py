"""A result folder of two tets, in the format of `orthodyn run`."""
import struct

import numpy as np

# Two tets that share the face 1 2 3; the second one is given inside out.
POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]], float)
TETS = np.array([[0, 1, 2, 3], [4, 1, 2, 3]])
TYPES = {"f4": "Float32", "f8": "Float64", "i4": "Int32", "i8": "Int64", "u1": "UInt8"}


def fields_at(t):
    """Node and cell fields of the two tets, growing with t."""
    axis = np.array([[0, 0, 1], [0.6, 0, 0.8]])
    node = {"displacement": t * POINTS, "velocity": POINTS.astype("f4")}
    cell = {"region": np.array([[0], [1]], "i4"), "det_f": np.full((2, 1), (1 + t) ** 3),
            "stress": np.array([[3.0, 0, 0, 0, 0, 0], [0, 0, 0, 2, 0, 0]]) * (1 + t) * 1e6, "material_axis_1": axis}
    return node, cell


class Vtu:
    """Writes a VTU as orthodyn does: appended raw, or ascii."""

    def __init__(self, points=POINTS, tets=TETS, form="appended", index="i8", header="<Q"):
        self.points, self.tets, self.form, self.index, self.header = points, tets, form, index, header
        self.blocks = b""

    def array(self, name, values):
        values = np.asarray(values)
        components = values.shape[1] if values.ndim > 1 else 1
        start = f'<DataArray type="{TYPES[values.dtype.str[1:]]}" Name="{name}" NumberOfComponents="{components}" '
        if self.form == "ascii":
            return start + f'format="ascii">{" ".join(repr(v) for v in values.ravel().tolist())}</DataArray>'
        offset, raw = len(self.blocks), values.tobytes()
        self.blocks += struct.pack(self.header, len(raw)) + raw
        return start + f'format="appended" offset="{offset}"/>'

    def content(self, node, cell, types=10):
        m = len(self.tets)
        body = ["<PointData>", *(self.array(k, v) for k, v in node.items()), "</PointData><CellData>",
                *(self.array(k, v) for k, v in cell.items()), "</CellData><Points>",
                self.array("Points", self.points), "</Points><Cells>",
                self.array("connectivity", self.tets.ravel().astype(self.index)),
                self.array("offsets", self.tets.shape[1] * np.arange(1, m + 1).astype(self.index)),
                self.array("types", np.full(m, types, "u1")), "</Cells>"]
        header_type = {"<Q": "UInt64", "<I": "UInt32"}[self.header]
        xml = (f'<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" '
               f'header_type="{header_type}"><UnstructuredGrid><Piece NumberOfPoints="{len(self.points)}" '
               f'NumberOfCells="{m}">{"".join(body)}</Piece></UnstructuredGrid>').encode()
        if self.form == "appended":
            xml += b'<AppendedData encoding="raw">_' + self.blocks + b"</AppendedData>"
        return xml + b"</VTKFile>"


def write_result(folder, times):
    (folder / "frames").mkdir(parents=True)
    sets = ""
    for k, t in enumerate(times):
        name = f"frames/frame_{k:05d}.vtu"
        (folder / name).write_bytes(Vtu().content(*fields_at(t)))
        sets += f'<DataSet timestep="{t!r}" file="{name}"/>'
    (folder / "frames.pvd").write_text(f'<VTKFile type="Collection"><Collection>{sets}</Collection></VTKFile>')
    return folder


def write_curves(folder):
    t = [0.1 * k for k in range(1, 11)]
    rows = {"energy": ("t [s],kinetic [J],elastic [J],loads [J],balance [J]", [(x, x, 1 - x, 0, 1e-9 * x) for x in t]),
            "steps": ("t [s],h [s],order,newton_iterations,rejected",
                      [(x, 0.1, 1 + k % 2, 2, k == 3) for k, x in enumerate(t)]),
            "probes": ("t [s],tip.displacement.x [m],tip.displacement.z [m],tip.velocity.x [m/s]",
                       [(x, x, -x, 1) for x in t]),
            "momentum": ("t [s],linear.x [kg m/s],linear.y [kg m/s]", [(x, 0, x) for x in t])}
    for name, (header, lines) in rows.items():
        text = "\n".join(",".join(str(float(v)) for v in line) for line in lines)
        (folder / f"{name}.csv").write_text(f"{header}\n{text}\n")
