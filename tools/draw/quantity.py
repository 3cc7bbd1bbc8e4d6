"""The quantity that colours the body: FIELD[.COMPONENT], one number per node or cell."""
from dataclasses import dataclass

import numpy as np

from .errors import unknown

SPACE = ("xx", "yy", "zz", "xy", "yz", "zx")
MATERIAL = ("11", "22", "33", "12", "23", "31")
UNITS = {"displacement": "m", "difference": "m", "velocity": "m/s", "stress": "Pa", "stress_material": "Pa", "von_mises": "Pa",
         "principal_stress": "Pa", "mesh_error": "J/m^3"}
AT_NODES = "nodal_"  # the same field, recovered at the nodes
# Nodal fields computed from recovered stresses.
FIGURES = ("von_mises", "principal_stress", "principal_strain", "max_stress", "tsai_wu", "hashin")
TITLES = {"von_mises": "von Mises", "tsai_wu": "Tsai-Wu", "hashin": "Hashin", "det_f": "volume ratio det F",
          "difference": "difference from the reference", "swing": "shape, with its sign"}
NEUTRAL = {"det_f": 1.0, "nodal_det_f": 1.0, "swing": 0.0}  # value of the undeformed body; 0 for other signed fields


def von_mises(s):
    """von Mises stress of (n,6) symmetric stresses ordered 11, 22, 33, 12, 23, 31 in any Cartesian frame."""
    normal = (s[:, 0] - s[:, 1]) ** 2 + (s[:, 1] - s[:, 2]) ** 2 + (s[:, 2] - s[:, 0]) ** 2
    return np.sqrt(0.5 * normal + 3 * (s[:, 3] ** 2 + s[:, 4] ** 2 + s[:, 5] ** 2))


def magnitude(v):
    """Length of vectors; Frobenius norm of symmetric tensors."""
    weight = np.array([1, 1, 1, 2, 2, 2]) if v.shape[1] == 6 else 1
    return np.sqrt((weight * v ** 2).sum(axis=1))


def without_region(field):
    """The field of REGION.FIELD; names of regions may contain dots."""
    return field.rpartition(".")[2]


def plain_name(field):
    return without_region(field).removeprefix(AT_NODES)


def component_names(field, count):
    if count == 6:
        field = plain_name(field)
        return MATERIAL if field in ("stress_material", "strain") else SPACE
    if without_region(field).startswith("principal_"):
        return "1", "2", "3"
    return {1: (), 3: ("x", "y", "z")}.get(count, tuple(str(i) for i in range(count)))


@dataclass(frozen=True)
class Quantity:
    """A quantity of a field. `kind` is the index of a component, or "magnitude", "von_mises" or "value"."""
    field: str
    kind: object
    label: str
    on_nodes: bool

    @property
    def unit(self):
        return UNITS.get(plain_name(self.field), "")

    @property
    def peaked(self):
        """Whether a few values may far exceed the others, as stresses do at corners and clamped edges."""
        return not self.on_nodes or without_region(self.field).startswith(AT_NODES) or without_region(self.field) in FIGURES

    @property
    def categorical(self):
        return self.field == "region"

    @property
    def neutral(self):
        """The value in the middle of a diverging colour map; None for a sequential map."""
        if self.field in NEUTRAL:
            return NEUTRAL[self.field]
        return 0.0 if isinstance(self.kind, int) else None

    def values(self, frame):
        fields = frame.node_fields if self.on_nodes else frame.cell_fields
        if self.field not in fields:
            raise unknown("field", self.field, [*frame.node_fields, *frame.cell_fields])
        data = fields[self.field].astype(float)
        if self.kind == "value":
            return data[:, 0]
        if self.kind in ("magnitude", "von_mises"):
            return {"magnitude": magnitude, "von_mises": von_mises}[self.kind](data)
        return data[:, self.kind]


def default_quantity(frame):
    """The von Mises stress if there are stresses, preferably nodal ones; else the displacement."""
    if AT_NODES + "stress" in frame.node_fields:
        return AT_NODES + "stress.von_mises"
    if "von_mises" in frame.node_fields:
        return "von_mises"
    return "stress.von_mises" if "stress" in frame.cell_fields else "displacement"


def _split(text, fields):
    """Field and component of `text`; field names may contain dots."""
    for name in sorted(fields, key=len, reverse=True):
        if text == name or text.startswith(name + "."):
            return name, text[len(name) + 1:]
    raise unknown("field", text, fields)


def find_quantity(text, frame):
    """The Quantity named by `text`; the default one for None."""
    fields = {**frame.cell_fields, **frame.node_fields}
    field, part = _split(text or default_quantity(frame), fields)
    on_nodes, count = field in frame.node_fields, fields[field].shape[1]
    plain = plain_name(field)
    region = field.rpartition(".")[0]
    title = (f"{region}: " if region else "") + TITLES.get(plain, plain.replace("_", " "))
    if count == 1 and not part:
        return Quantity(field, "value", title, on_nodes)
    components = component_names(field, count)
    stress = count == 6 and plain.startswith("stress")
    principal = plain.startswith("principal_")
    derived = ["magnitude"] * (count > 1 and not principal) + ["von_mises"] * stress
    part = part or (components[0] if principal else derived[-1])
    if part in derived:
        return Quantity(field, part, f"{title}, {part.replace('von_mises', 'von Mises')}", on_nodes)
    if part in components:
        return Quantity(field, components.index(part), f"{title} {part}", on_nodes)
    raise unknown(f"component of {field}", part, [*components, *derived])
