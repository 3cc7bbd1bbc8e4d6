#!/usr/bin/env python3
"""The top plate of a classical guitar as a Gmsh file of 20-node hexahedra: a plate of 2.5 mm with a sound hole, and
under it five fan braces and two transverse bars, 6 mm wide and 5 mm high. Lengths in the file are in metres, x is from
the lower end to the neck, z out of the body; the lower side of the plate is z = 0.

    python3 guitar_top.py guitar_top.msh                  # the shipped mesh
    python3 guitar_top.py fine.msh --fine 2               # cells half as large in the plane
    python3 guitar_top.py fine.msh --fine 2 --layers 2    # and half as high

Seen from above, cells are a grid of rows (across) and columns (along), a ring between the grid and the outline, and a
ring around the sound hole. Fan braces are columns between two rows, transverse bars are rows of the grid; they share
nodes with the plate. The bars end at the outer ring.
"""
import argparse
from bisect import bisect_right
from math import atan2, cos, exp, hypot, pi, radians, sin

# Lengths in mm.
LENGTH, THICKNESS = 480, 2.5
BRACE_WIDTH, BRACE_HEIGHT = 6, 5
RIM, RIM_AT_CORNERS = 20, 7                # width of the ring along the outline, and at the corners of the grid
FAN_ANGLES = 8, 16                         # degrees from the middle brace; the axes meet at the neck's end of the plate
FAN_START, FAN_END = 410, 230              # distances of the braces' ends from there
LOWER_BAR, UPPER_BAR = (273, 279), (381, 387)         # x of the sides
HOLE_X, HOLE_RADIUS, HOLE_RING = 330, 43, 52          # the ring around the hole reaches to these y

# Numbers of cells.
ROWS = 3, 12, 1, 1, 6, 1, 4                # lower end, fan, gap, bar, hole, bar, upper end
COLUMNS = 2, 1, 1, 1, 1, 3                 # from the middle brace outwards: gap, brace, two halves of a gap, brace, side
HOLE_CELLS = 2                             # across the ring around the hole


def outline(t):
    """361 mm wide at the lower bout, 235 mm at the waist, 281 mm at the upper bout; from t = 0 to pi at the neck."""
    c = cos(t)
    return LENGTH / 2 * (1 - c), sin(t) * (137 + 123 * c + 180 * c**2 - 297 * c**3 - 62 * c**4 + 174 * c**5)


def normal(t):
    """Out of the body."""
    (x0, y0), (x1, y1) = outline(t - 1e-5), outline(t + 1e-5)
    size = hypot(x1 - x0, y1 - y0)
    return (y0 - y1) / size, (x1 - x0) / size


def root(f, low, high):
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if (f(low) < 0) != (f(middle) < 0) else (middle, high)
    return low


# Corners of the grid, where the outline has these directions.
LOWER_CORNER = root(lambda t: atan2(normal(t)[1], -normal(t)[0]) - radians(50), 0.05, 1)
UPPER_CORNER = root(lambda t: atan2(normal(t)[1], normal(t)[0]) - radians(45), 2.2, 3.1)


def inner(t):
    """The inner side of the ring along the outline. It has corners, too: cells without them would be triangles."""
    (x, y), (a, b) = outline(t), normal(t)
    near = max(exp(-abs(t - corner) / 0.15) for corner in (LOWER_CORNER, UPPER_CORNER))
    width = RIM + (RIM_AT_CORNERS - RIM) * near
    return x - width * a, y - width * b


def between(a, b, s):
    return a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])


def find(counts, at):
    """The part in which the cell coordinate `at` lies, and where in it, from 0 to 1."""
    starts = [sum(counts[:k]) for k in range(len(counts))]
    k = bisect_right(starts, at) - 1
    return k, (at - starts[k]) / counts[k]


def polyline(points, counts):
    """A function of the cell coordinate; counts are the numbers of cells between two points."""
    def point(at):
        k, s = find(counts, at)
        return between(points[k], points[k + 1], s)
    return lambda at: points[-1] if at == sum(counts) else point(at)


def patch(low, high, left, right, s, r):
    """Coons patch: low and high are sides along s, left and right are sides along r, all from 0 to 1."""
    def blend(k):
        corners = between(between(low(0), low(1), s), between(high(0), high(1), s), r)
        return (1 - r) * low(s)[k] + r * high(s)[k] + (1 - s) * left(r)[k] + s * right(r)[k] - corners[k]
    return blend(0), blend(1)


class Plan:
    """The half y >= 0 as functions of cell coordinates: row from 0 at the lower end, column from 0 at y = 0."""

    def __init__(self, fine):
        self.rows, self.columns = [fine * n for n in ROWS], [fine / 2, *(fine * n for n in COLUMNS)]
        self.length, self.half = sum(self.rows), sum(self.columns)
        self.hole_rows, self.hole_columns = (sum(self.rows[:4]), sum(self.rows[:5])), sum(self.columns[:4])
        ends = [root(lambda t, x=x: inner(t)[0] - x, 0.4, 2.9) for x in (100, 252, *LOWER_BAR, *UPPER_BAR)]
        parameters = polyline([(t, 0) for t in (LOWER_CORNER, *ends, UPPER_CORNER)], self.rows)
        # Parameters of the outline at the ends of rows and columns.
        self.side = lambda row: parameters(row)[0]
        self.lower = lambda column: LOWER_CORNER * column / self.half
        self.upper = lambda column: pi + (UPPER_CORNER - pi) * column / self.half
        beside = [self.hole_columns, self.half - self.hole_columns]
        self.given = [None, self.fan_row(FAN_START, inner(ends[0])), self.fan_row(FAN_END, inner(ends[1]))]
        bars = zip(LOWER_BAR + UPPER_BAR, ends[2:])
        self.given += [polyline([(x, 0), (x, HOLE_RING), inner(t)], beside) for x, t in bars]

    def fan_row(self, radius, end):
        """The row through ends of the fan braces."""
        def at(degrees, side):
            a, w = radians(degrees), side * BRACE_WIDTH / 2
            return LENGTH - radius * cos(a) + w * sin(a), radius * sin(a) + w * cos(a)
        a, b = FAN_ANGLES
        middle = between(at(a, 1), at(b, -1), 0.5)
        return polyline([at(0, 0), at(0, 1), at(a, -1), at(a, 1), middle, at(b, -1), at(b, 1), end], self.columns)

    def grid(self, row, column):
        part, r = find(self.rows, row)
        low, high = self.given[part], self.given[part + 1] if part + 1 < len(self.rows) else None
        first = sum(self.rows[:part])
        s = column / self.half

        def end(q):
            return inner(self.side(first + q * self.rows[part]))

        def lower_end(q):
            return inner(self.lower(q * self.half))

        def upper_end(q):
            return inner(self.upper(q * self.half))

        if part == 0:
            return patch(lower_end, lambda q: high(q * self.half), lambda q: between(inner(0), high(0), q), end, s, r)
        if part == len(self.rows) - 1:
            return patch(lambda q: low(q * self.half), upper_end, lambda q: between(low(0), inner(pi), q), end, s, r)
        side = self.columns[-1]
        straight = {1: self.half - side, 2: self.half - side, 4: self.hole_columns}.get(part, self.half)
        if column <= straight:
            return between(low(column), high(column), r)
        return between(between(low(straight), high(straight), r), end(r), (column - straight) / (self.half - straight))

    def rim(self, place):
        """Points on the inner side of the ring and on the outline; places count cells from y = 0 at the lower end."""
        if place < self.half:
            return self.grid(0, place), outline(self.lower(place))
        if place <= self.half + self.length:
            return self.grid(place - self.half, self.half), outline(self.side(place - self.half))
        column = 2 * self.half + self.length - place
        return self.grid(self.length, column), outline(self.upper(column))

    def hole(self, place):
        """Points on the outer side of the hole's ring and on the hole."""
        low, high = self.hole_rows
        n, m = self.hole_columns, high - low
        if place < n:
            point, angle = self.grid(low, place), place / n * pi / 4
        elif place <= n + m:
            point, angle = self.grid(low + place - n, n), pi / 4 + (place - n) / m * pi / 2
        else:
            point, angle = self.grid(high, 2 * n + m - place), pi - (2 * n + m - place) / n * pi / 4
        return point, (HOLE_X - HOLE_RADIUS * cos(angle), HOLE_RADIUS * sin(angle))


def mirrored(f):
    """Extends a function of the column or place to y < 0."""
    def g(at, *rest):
        x, y = f(abs(at), *rest)
        if abs(y) < 1e-9:            # sin(pi) is not quite 0
            y = 0.0
        return x, y if at >= 0 else -y
    return g


def cells(fine):
    """Quadrilaterals (corners, region of the brace below or None), middles of curved edges, edges of the outline."""
    plan = Plan(fine)
    quads, curved, rim = [], {}, set()
    grid = mirrored(lambda column, row: plan.grid(row, column))
    for row in range(plan.length):
        for k in range(int(2 * plan.half)):
            column = k - plan.half
            part, _ = find(plan.rows, row)
            across, _ = find(plan.columns, abs(column + 0.5))
            if part == 4 and across < 4:
                continue
            brace = "transverse" if part in (3, 5) else "fan" if part == 1 and across in (0, 2, 5) else None
            corners = (column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1)
            quads.append(([grid(*corner) for corner in corners], brace))

    def ring(ends, half, layers, edges):
        """Cells between two closed curves, the second one round."""
        point = mirrored(lambda place, s: between(*ends(place), s) if s < 1 else ends(place)[1])
        at = lambda place, s: point(place if place <= half else place - 2 * half, s)
        for k in range(int(2 * half)):
            a = k - half + plan.half % 1                # where the grid has its columns
            b = a + 1
            for layer in range(layers):
                s, r = layer / layers, (layer + 1) / layers
                quads.append(([at(a, s), at(b, s), at(b, r), at(a, r)], None))
            edge = frozenset((at(a, 1), at(b, 1)))
            curved[edge] = at((a + b) / 2, 1)
            edges.add(edge)

    ring(plan.rim, 2 * plan.half + plan.length, fine, rim)
    ring(plan.hole, 2 * plan.hole_columns + plan.hole_rows[1] - plan.hole_rows[0], fine * HOLE_CELLS, set())
    return quads, curved, rim


# Of a hexahedron, in Gmsh's order: corners of the quadrilateral and levels; ends of edges.
CORNERS = [(0, 0), (1, 0), (2, 0), (3, 0), (0, 1), (1, 1), (2, 1), (3, 1)]
EDGES = [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)]


def write(path, fine, layers):
    quads, curved, rim = cells(fine)
    numbers, lines = {}, []

    def node(x, y, z):
        x, y = x + 0.0, y + 0.0        # no -0
        if (x, y, z) not in numbers:
            numbers[x, y, z] = len(numbers) + 1
        return numbers[x, y, z]

    def middle(p, q):
        (x, y, z), (u, v, w) = sorted((p, q))
        a, b = curved.get(frozenset(((x, y), (u, v))), ((x + u) / 2, (y + v) / 2))
        return a, b, (z + w) / 2

    def element(kind, tag, corners, edges):
        points = corners + [middle(corners[i], corners[j]) for i, j in edges]
        lines.append(f"{len(lines) + 1} {kind} 2 {tag} {tag} " + " ".join(str(node(*p)) for p in points))

    def column(corners, tag, low, high):
        for k in range(layers):
            z = low + (high - low) * k / layers, low + (high - low) * (k + 1) / layers
            element(17, tag, [(*corners[c], z[level]) for c, level in CORNERS], EDGES)

    names = {"plate": 1, "fan": 2, "transverse": 3}
    for corners, brace in quads:
        area = sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(corners, corners[1:] + corners[:1]))
        corners = corners if area > 0 else corners[::-1]
        column(corners, 1, 0.0, THICKNESS)
        if brace:
            column(corners, names[brace], -float(BRACE_HEIGHT), 0.0)
    for p, q in (sorted(edge) for edge in rim):
        for k in range(layers):
            z, w = THICKNESS * k / layers, THICKNESS * (k + 1) / layers
            element(16, 4, [(*p, z), (*q, z), (*q, w), (*p, w)], [(0, 1), (1, 2), (2, 3), (3, 0)])

    with open(path, "w", encoding="ascii") as out:
        out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n")
        out.write('3 1 "plate"\n3 2 "fan"\n3 3 "transverse"\n2 4 "rim"\n$EndPhysicalNames\n$Nodes\n')
        out.write(f"{len(numbers)}\n")
        for (x, y, z), number in numbers.items():
            out.write(f"{number} {x / 1000:.9g} {y / 1000:.9g} {z / 1000:.9g}\n")
        out.write(f"$EndNodes\n$Elements\n{len(lines)}\n" + "\n".join(lines) + "\n$EndElements\n")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("file")
    parser.add_argument("--fine", type=int, default=1, help="factor of the number of cells along and across")
    parser.add_argument("--layers", type=int, default=1, help="cells over the height of plate and braces")
    given = parser.parse_args()
    write(given.file, given.fine, given.layers)
