#!/usr/bin/env python3
"""Prints the table of docs/accuracy.md: strains under uniaxial stress at which elastic laws lose strong ellipticity.

For each law and each axis of a material, the stretches across are those without stress across. The second variation of
the energy is computed by differences, and its smallest eigenvalue is searched over directions of the wave.
"""
import numpy as np

EYE = np.eye(3)


def stiffness(young, nu12, nu23, nu13, g12, g23, g13):
    """C (Pa) for the strains 11, 22, 33, and the shear moduli of the planes 12, 23, 31."""
    E1, E2, E3 = young
    compliance = np.array([[1 / E1, -nu12 / E1, -nu13 / E1], [-nu12 / E1, 1 / E2, -nu23 / E2],
                           [-nu13 / E1, -nu23 / E2, 1 / E3]])
    return np.linalg.inv(compliance), (g12, g23, g13)


def stable(young, nu):
    """Li and Barbic's family: Poisson's ratios nu sqrt(Ei/Ej), shear moduli sqrt(Ei Ej)/(2 (1 + nu))."""
    E = np.asarray(young)
    ratio = lambda i, j: nu * np.sqrt(E[i] / E[j])
    shear = lambda i, j: np.sqrt(E[i] * E[j]) / (2 * (1 + nu))
    return stiffness(E, ratio(0, 1), ratio(1, 2), ratio(0, 2), shear(0, 1), shear(1, 2), shear(0, 2))


def energy(strain, material):
    C, (g12, g23, g13) = material
    e = np.diag(strain)
    shear = g12 * strain[0, 1]**2 + g23 * strain[1, 2]**2 + g13 * strain[2, 0]**2
    return 0.5 * e @ C @ e + 2 * shear


def stretch_strain(function):
    def strain(F):
        squares, V = np.linalg.eigh(F.T @ F)
        return V @ np.diag(function(np.sqrt(squares))) @ V.T
    return strain


MUSCLE = stiffness([447, 22.4, 22.4], 0.47, 0.45, 0.47, 25e3 / 1e3, 7.72, 25e3 / 1e3)  # kPa

LAWS = {
    "corotational (this program)": stretch_strain(lambda s: s - 1),
    "St. Venant-Kirchhoff": stretch_strain(lambda s: (s * s - 1) / 2),
    "Hencky": stretch_strain(np.log),
}


def stretches(law, material, axis, along):
    """The principal stretches with no stress across, for a stretch along one axis: the strain measure is linear."""
    C, _ = material
    others = [i for i in range(3) if i != axis]
    measure = {"corotational (this program)": (lambda s: s - 1, lambda e: 1 + e),
               "St. Venant-Kirchhoff": (lambda s: (s * s - 1) / 2, lambda e: np.sqrt(np.maximum(1 + 2 * e, 0))),
               "Hencky": (np.log, np.exp)}[law]
    across = -np.linalg.solve(C[np.ix_(others, others)], C[others, axis] * measure[0](along))
    out = np.empty(3)
    out[axis] = along
    out[others] = measure[1](across)
    return out


def hessian(law, material, F, h=1e-4):
    W = lambda G: energy(LAWS[law](G), material)
    H = np.empty((9, 9))
    unit = [h * np.outer(EYE[k // 3], EYE[k % 3]) for k in range(9)]
    for i in range(9):
        for j in range(i, 9):
            H[i, j] = H[j, i] = (W(F + unit[i] + unit[j]) - W(F + unit[i] - unit[j]) - W(F - unit[i] + unit[j]) +
                                 W(F - unit[i] - unit[j])) / (4 * h * h)
    return H


def directions():
    k = np.arange(2000)
    z, phi = 1 - (k + 0.5) / 2000, k * np.pi * (3 - np.sqrt(5))
    r = np.sqrt(1 - z * z)
    sphere = np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=1)
    t = np.linspace(0, np.pi, 361)
    planes = [np.stack([np.cos(t), np.sin(t), 0 * t], axis=1)[:, p] for p in ([0, 1, 2], [1, 2, 0], [2, 0, 1])]
    return np.concatenate([sphere, *planes])


DIRECTIONS = directions()


def is_elliptic(law, material, axis, strain):
    s = stretches(law, material, axis, 1 + strain)
    if not (s > 1e-3).all():
        return False
    A = hessian(law, material, np.diag(s)).reshape(3, 3, 3, 3)  # i, J, k, L
    acoustic = np.einsum("nj,ijkl,nl->nik", DIRECTIONS, A, DIRECTIONS)
    return np.linalg.eigvalsh(acoustic).min() > 0


def limit(law, material, axis, sign, farthest):
    step = 0.01
    last, now = 0.0, step
    while is_elliptic(law, material, axis, sign * now):
        last, now = now, now + step
        if now > farthest:
            return None
    for _ in range(7):
        middle = (last + now) / 2
        last, now = (middle, now) if is_elliptic(law, material, axis, sign * middle) else (last, middle)
    return sign * last


def main():
    spruce = 11.88  # GPa; the preset sitka_spruce
    materials = {
        "Sitka spruce, across the grain (2)": (stiffness(spruce * np.array([1, 0.078, 0.043]), 0.372, 0.435, 0.467,
                                                         0.064 * spruce, 0.003 * spruce, 0.061 * spruce), 1),
        "fibres 10:1, along (1)": (stable([10, 1, 1], 0.3), 0),
        "fibres 10:1, across (2)": (stable([10, 1, 1], 0.3), 1),
        "fibres 20:1 with the moduli of muscle, along (1)": (MUSCLE, 0),
        "isotropic, nu 0.3": (stable([1, 1, 1], 0.3), 0),
    }
    print("| material, axis | " + " | ".join(LAWS) + " |\n|" + "---|" * (len(LAWS) + 1))
    for name, (material, axis) in materials.items():
        cells = []
        for law in LAWS:
            ends = [limit(law, material, axis, sign, farthest) for sign, farthest in ((-1, 0.9), (1, 1))]
            cells.append(" / ".join("none" if end is None else f"{100 * end:+.0f}" for end in ends))
        print(f"| {name} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
