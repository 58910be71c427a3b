"""Compares our measures with their definitions, in decimals of 60 digits, on random and near-degenerate tetrahedra.

Usage: check_exact.py MEASURE_PROBE. Exit status 77 (skipped) where NumPy isn't installed.
"""

import math
import sys
from decimal import Decimal, getcontext

try:
    import numpy as np
    from tets import ALLOWED_ERROR, NAMES, measured, plumpness, random_tets
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

getcontext().prec = 60
PAIRS = [(i, j) for i in range(4) for j in range(i + 1, 4)]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def norm(a):
    return dot(a, a).sqrt()


def circumradius(p):
    """By the centre, from Cramer's rule for its equal distances."""
    rows = [minus(p[k], p[0]) for k in (1, 2, 3)]
    right = [dot(row, row) / 2 for row in rows]
    normals = [cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])]
    determinant = dot(rows[0], normals[0])
    center = [sum(r * n[k] for r, n in zip(right, normals)) / determinant for k in range(3)]
    return norm(center)


def angle(sine, cosine):
    return math.atan2(float(sine), float(cosine))


def dihedral(p, i, j):
    """Between the parts of the other two edges that are at right angles to the edge i-j."""
    k, l = (m for m in range(4) if m not in (i, j))
    edge = minus(p[j], p[i])
    across = [minus(minus(p[m], p[i]), [x * dot(minus(p[m], p[i]), edge) / dot(edge, edge) for x in edge]) for m in (k, l)]
    return math.degrees(angle(norm(cross(*across)), dot(*across)))


def solid_angle(p, i):
    """By the unit vectors from the corner, after van Oosterom and Strackee."""
    a, b, c = (minus(p[m], p[i]) for m in range(4) if m != i)
    a, b, c = ([x / norm(v) for x in v] for v in (a, b, c))
    return 2 * angle(abs(dot(a, cross(b, c))), 1 + dot(a, b) + dot(b, c) + dot(c, a))


def root(x, n):
    return x ** (Decimal(1) / n)


def exact(tet):
    p = [[Decimal(float(x)) for x in point] for point in tet]
    lengths = {(i, j): norm(minus(p[j], p[i])) for i, j in PAIRS}
    longest, shortest, total = max(lengths.values()), min(lengths.values()), sum(lengths.values())
    squares = sum(length * length for length in lengths.values())
    volume = dot(minus(p[1], p[0]), cross(minus(p[2], p[0]), minus(p[3], p[0]))) / 6
    areas = [norm(cross(minus(p[b], p[a]), minus(p[c], p[a]))) / 2
             for a, b, c in ((1, 2, 3), (0, 2, 3), (0, 1, 3), (0, 1, 2))]
    inradius, outer = 3 * volume / sum(areas), circumradius(p)
    two, three, six = (Decimal(n).sqrt() for n in (2, 3, 6))
    dihedrals = [dihedral(p, i, j) for i, j in PAIRS]
    solids = [solid_angle(p, i) for i in range(4)]
    at_corner = [math.prod(length for pair, length in lengths.items() if i in pair) for i in range(4)]
    return {
        "volume": volume,
        "beta": 3 * inradius / outer,
        "sigma": 2 * six * inradius / longest,
        "omega": six / 4 * longest / outer,
        "tau": shortest / longest,
        "kappa": 2187 * volume ** 4 / sum(a * a for a in areas) ** 3,
        "alpha": 6 * two * volume / (total / 6) ** 3,
        "gamma": 6 * two * volume / (squares / 6).sqrt() ** 3,
        "dihedral_min": min(dihedrals),
        "dihedral_max": max(dihedrals),
        "solid_angle_min": min(solids),
        "solid_angle_max": max(solids),
        "aspect": three / two * min(3 * volume / a for a in areas) / longest,
        "condition": 18 * volume / (squares * sum(a * a for a in areas)).sqrt(),
        "mean_ratio": 12 * root(3 * volume, 3) ** 2 / squares,
        "scaled_jacobian": two * 6 * volume / max(at_corner),
    }


def main():
    seed, n = 1988, 4000
    print(f"{n} tetrahedra, seed {seed}")
    tets = random_tets(n, np.random.default_rng(seed))
    ours = measured(sys.argv[1], tets)
    truths = [exact(tet) for tet in tets]
    plump = plumpness(tets, ours["volume"])
    failed = False
    for name in NAMES:
        truth = np.array([float(t[name]) for t in truths])
        error = np.abs(ours[name] - truth) / np.abs(truth)
        worst = int(np.argmax(error))
        print(f"{name:16} greatest relative error {error.max():.2e}, where plump {error[plump > 1e-3].max():.2e}")
        if not error[worst] <= ALLOWED_ERROR:
            failed = True
            print(f"  ours {ours[name][worst]!r}, exact {truth[worst]!r}, of {tets[worst].tolist()}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
