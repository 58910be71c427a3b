"""Tetrahedra to measure, and what maille says of them."""

import subprocess

import numpy as np

NAMES = ("volume beta sigma omega tau kappa alpha gamma dihedral_min dihedral_max solid_angle_min solid_angle_max aspect "
         "condition mean_ratio scaled_jacobian").split()


ALLOWED_ERROR = 1e-10  # relative


def random_tets(n, rng):
    """Positively oriented: as they come, flattened, with a short edge, with a point near an edge."""
    tets = rng.uniform(-1, 1, (n, 4, 3))
    kinds = np.array_split(np.arange(n), 4)
    tets[kinds[1], :, 2] *= 10 ** rng.uniform(-4, 0, (len(kinds[1]), 1))
    short = 10 ** rng.uniform(-4, 0, (len(kinds[2]), 1))
    tets[kinds[2], 3] = tets[kinds[2], 0] + short * rng.uniform(-1, 1, (len(kinds[2]), 3))
    middle = (tets[kinds[3], 0] + tets[kinds[3], 1]) / 2
    tets[kinds[3], 3] = middle + 10 ** rng.uniform(-3, 0, (len(kinds[3]), 1)) * rng.uniform(-1, 1, (len(kinds[3]), 3))
    spokes = tets[:, 1:] - tets[:, :1]
    inverted = np.linalg.det(spokes) < 0
    tets[inverted] = tets[inverted][:, [1, 0, 2, 3]]
    return np.ascontiguousarray(tets)


def measured(probe, tets):
    """By name, what the program at `probe` works out."""
    run = subprocess.run([probe], input=tets.tobytes(), capture_output=True, check=True)
    return dict(zip(NAMES, np.frombuffer(run.stdout).reshape(len(tets), -1).T))


def plumpness(tets, volume):
    """The volume over the cube of the longest edge; doubles lose as many digits of it as this is below 1."""
    edges = np.array([tets[:, j] - tets[:, i] for i in range(4) for j in range(i + 1, 4)])
    return np.abs(volume) / np.sqrt((edges**2).sum(-1)).max(0) ** 3
