"""Compares our measures with VTK's Verdict on random and near-degenerate tetrahedra.

Where the two differ by more than 1e-10, which happens on the flattest alone, the measure is worked out in decimals of 60
digits: the difference must be Verdict's.

Usage: check_verdict.py MEASURE_PROBE. Exit status 77 (skipped) where VTK or NumPy isn't installed.
"""

import sys

try:
    import numpy as np
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkIdTypeArray, vtkPoints
    from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkCellArray, vtkUnstructuredGrid
    from vtkmodules.vtkFiltersVerdict import vtkMeshQuality

    from check_exact import exact
    from tets import ALLOWED_ERROR, measured, plumpness, random_tets
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


# Ours as Verdict defines them: the inverse, mostly; its "shape" is the mean ratio.
AS_VERDICT = {
    "Volume": lambda m: m["volume"],
    "Jacobian": lambda m: 6 * m["volume"],
    "RadiusRatio": lambda m: 1 / m["beta"],
    "AspectRatio": lambda m: 1 / m["sigma"],
    "EdgeRatio": lambda m: 1 / m["tau"],
    "AspectGamma": lambda m: 1 / m["gamma"],
    "Condition": lambda m: 1 / m["condition"],
    "Shape": lambda m: m["mean_ratio"],
    "AspectFrobenius": lambda m: 1 / m["mean_ratio"],
    "ScaledJacobian": lambda m: m["scaled_jacobian"],
}


def exact_measures(tets):
    """By name, each measure of all of them, rounded once."""
    all_of = [exact(tet) for tet in tets]
    return {name: [float(one[name]) for one in all_of] for name in all_of[0]}


def main():
    seed = 2007
    n = 100_000
    print(f"{n} tetrahedra, seed {seed}")
    tets = random_tets(n, np.random.default_rng(seed))
    mine = measured(sys.argv[1], tets)
    plump = plumpness(tets, mine["volume"])
    failed = False
    for name, convert in AS_VERDICT.items():
        ours, theirs = convert(mine), verdict(tets, name)
        error = np.abs(theirs - ours) / np.maximum(np.abs(ours), 1e-300)
        print(f"{name:15} greatest relative difference {error.max():.2e}, where plump {error[plump > 1e-3].max():.2e}", end="")
        apart = np.flatnonzero(~(error <= ALLOWED_ERROR))
        if len(apart) == 0:
            print()
            continue
        truth = convert({key: np.array(values) for key, values in exact_measures(tets[apart]).items()})
        own_error = np.abs(ours[apart] / truth - 1).max()
        print(f"; {len(apart)} differ by more than {ALLOWED_ERROR:.0e}, and there ours is right to {own_error:.2e}")
        # A definition that differs would do so everywhere.
        failed |= not own_error <= ALLOWED_ERROR or len(apart) > n / 100
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
