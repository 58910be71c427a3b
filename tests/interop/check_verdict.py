"""Compares our measures with VTK's Verdict on random and near-degenerate tetrahedra.

Usage: check_verdict.py MEASURE_PROBE. Exit status 77 (skipped) where VTK or NumPy isn't installed.
"""

import sys

try:
    import numpy as np
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkIdTypeArray, vtkPoints
    from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkCellArray, vtkUnstructuredGrid
    from vtkmodules.vtkFiltersVerdict import vtkMeshQuality

    from tets import allowed_error, measured, plumpness, random_tets
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)


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
    mine = measured(sys.argv[1], tets)
    volume = mine["volume"]
    plump = plumpness(tets, volume)
    # Ours as Verdict defines them: the inverse, mostly; its "shape" is the mean ratio.
    expected = {
        "Volume": volume,
        "Jacobian": 6 * volume,
        "RadiusRatio": 1 / mine["beta"],
        "AspectRatio": 1 / mine["sigma"],
        "EdgeRatio": 1 / mine["tau"],
        "AspectGamma": 1 / mine["gamma"],
        "Condition": 1 / mine["condition"],
        "Shape": mine["mean_ratio"],
        "AspectFrobenius": 1 / mine["mean_ratio"],
        "ScaledJacobian": mine["scaled_jacobian"],
    }
    failed = False
    for name, value in expected.items():
        theirs = verdict(tets, name)
        error = np.abs(theirs - value) / np.maximum(np.abs(value), 1e-300)
        allowed = allowed_error(plump)
        worst = int(np.argmax(error / allowed))
        print(f"{name:15} greatest relative difference {error.max():.2e}, where plump {error[plump > 1e-3].max():.2e}")
        if not error[worst] <= allowed[worst]:
            failed = True
            print(f"  differs: ours {value[worst]!r}, Verdict's {theirs[worst]!r}, of {tets[worst].tolist()}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
