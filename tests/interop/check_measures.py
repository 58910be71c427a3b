"""Compares our measures with VTK's Verdict on random and near-degenerate tetrahedra.

Usage: check_measures.py MEASURE_PROBE. Exit status 77 (skipped) where VTK or NumPy isn't installed.
"""

import subprocess
import sys

try:
    import numpy as np
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkIdTypeArray, vtkPoints
    from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkCellArray, vtkUnstructuredGrid
    from vtkmodules.vtkFiltersVerdict import vtkMeshQuality
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

NAMES = "volume beta sigma tau gamma condition mean_ratio scaled_jacobian".split()


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


def ours(probe, tets):
    run = subprocess.run([probe], input=tets.tobytes(), capture_output=True, check=True)
    return dict(zip(NAMES, np.frombuffer(run.stdout).reshape(len(tets), -1).T))


def verdict(tets, measure):
    grid = vtkUnstructuredGrid()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(tets.reshape(-1, 3), deep=True))
    grid.SetPoints(points)
    cells = vtkCellArray()
    n = len(tets)
    connectivity = np.column_stack([np.full(n, 4), np.arange(4 * n).reshape(n, 4)]).ravel()
    ids = vtkIdTypeArray()
    ids.DeepCopy(numpy_to_vtk(connectivity.astype(np.int64), deep=True, array_type=ids.GetDataType()))
    cells.ImportLegacyFormat(ids)
    grid.SetCells(VTK_TETRA, cells)
    quality = vtkMeshQuality()
    quality.SetInputData(grid)
    getattr(quality, f"SetTetQualityMeasureTo{measure}")()
    quality.Update()
    return vtk_to_numpy(quality.GetOutput().GetCellData().GetArray("Quality")).copy()


def main():
    seed = 2007
    n = 100_000
    print(f"{n} tetrahedra, seed {seed}")
    tets = random_tets(n, np.random.default_rng(seed))
    mine = ours(sys.argv[1], tets)
    volume = mine["volume"]
    edges = np.array([tets[:, j] - tets[:, i] for i in range(4) for j in range(i + 1, 4)])
    longest = np.sqrt((edges**2).sum(-1)).max(0)
    # How many digits the volume itself has: 1 where the tetrahedron is plump.
    plump = np.abs(volume) / longest**3
    # Ours as Verdict defines them: the inverse, mostly; its "shape" is the mean ratio.
    expected = {
        "Volume": volume,
        "RadiusRatio": 1 / mine["beta"],
        "AspectRatio": 1 / mine["sigma"],
        "EdgeRatio": 1 / mine["tau"],
        "AspectGamma": 1 / mine["gamma"],
        "Condition": 1 / mine["condition"],
        "Shape": mine["mean_ratio"],
        "ScaledJacobian": mine["scaled_jacobian"],
    }
    failed = False
    for name, value in expected.items():
        theirs = verdict(tets, name)
        error = np.abs(theirs - value) / np.maximum(np.abs(value), 1e-300)
        # Both lose as many digits as the volume does by cancellation; nothing is lost where it is plump.
        allowed = 1e-10 * np.maximum(1, 1e-5 / plump)
        worst = int(np.argmax(error / allowed))
        print(f"{name:15} greatest relative difference {error.max():.2e}, where plump {error[plump > 1e-3].max():.2e}")
        if not error[worst] <= allowed[worst]:
            failed = True
            print(f"  differs: ours {value[worst]!r}, Verdict's {theirs[worst]!r}, of {tets[worst].tolist()}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
