#!/usr/bin/python3
"""Quality before and after improvement, beside Gmsh's and Netgen's, at the same number of tetrahedra.

Usage: compare.py [--maille PROGRAM] [--cells N] [--peers PEER...] [--folder FOLDER] [WHAT...]
WHAT is any of the scenes box_cylinder sphere_box cylinders_sphere box_27spheres, examples, and cube (refined);
all if none is given. Prints the tables of docs/quality.md; meshes stay in the folder. Takes python3-vtk9,
python3-meshio, python3-gmsh and python3-netgen; what is missing is left out.

beta = 3 r / R is by VTK's Verdict; it has no right measure of dihedral angles, which are by NumPy here.
"""

import argparse
import json
import math
import subprocess
import sys
from pathlib import Path

import meshio
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdTypeArray, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkCellArray, vtkUnstructuredGrid
from vtkmodules.vtkFiltersVerdict import vtkMeshQuality

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SCENES = {"box_cylinder": "box - cylinder", "sphere_box": "sphere + box",
          "cylinders_sphere": "3 cylinders - sphere", "box_27spheres": "box - 27 spheres"}
PEERS = {"gmsh": "Gmsh, Delaunay, -optimize", "gmsh-hxt": "Gmsh, HXT", "netgen": "Netgen"}
HEADER = """| | program | cells | CPU s | angles, degrees | beta, least | beta, mean |
|---|---|---|---|---|---|---|"""
VOLUMES = {"box_cylinder": 8 - math.pi / 2, "sphere_box": 7 / 6 * math.pi + 1.2**3,
           "box_27spheres": 27 - 36 * math.pi * 0.35**3}
CUBE_SIZE = "0.0008+0.05*(1-exp(-r))"


def verdict_beta(points, cells):
    """beta of all cells by VTK's Verdict."""
    grid = vtkUnstructuredGrid()
    vtk_points = vtkPoints()
    vtk_points.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    grid.SetPoints(vtk_points)
    table = np.column_stack([np.full(len(cells), 4), cells]).ravel().astype(np.int64)
    ids = vtkIdTypeArray()
    ids.DeepCopy(numpy_to_vtk(table, deep=True, array_type=ids.GetDataType()))
    array = vtkCellArray()
    array.ImportLegacyFormat(ids)
    grid.SetCells(VTK_TETRA, array)

    quality = vtkMeshQuality()
    quality.SetInputData(grid)
    quality.SetTetQualityMeasureToRadiusRatio()
    quality.Update()
    return 1 / vtk_to_numpy(quality.GetOutput().GetCellData().GetArray("Quality"))


def extreme_angles(points, cells):
    """The smallest and the largest dihedral angle, in degrees."""
    p = points[cells]
    faces = [(1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)]
    normals = [np.cross(p[:, b] - p[:, a], p[:, c] - p[:, a]) for a, b, c in faces]
    normals = [n / np.linalg.norm(n, axis=1)[:, None] for n in normals]
    cosines = [-(normals[i] * normals[j]).sum(1) for i in range(4) for j in range(i)]
    return [math.degrees(math.acos(c)) for c in (max(c.max() for c in cosines), min(c.min() for c in cosines))]


def volume(points, cells):
    p = points[cells]
    return np.einsum("ij,ij->", np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), p[:, 3] - p[:, 0]) / 6


def row(title, program, seconds, points, cells):
    beta = verdict_beta(points, cells)
    smallest, largest = extreme_angles(points, cells)
    print(f"| {title} | {program} | {len(cells):,} | {seconds:.2f} "
          f"| {smallest:.1f}..{largest:.1f} | {beta.min():.3f} | {beta.mean():.3f} |",
          flush=True)


def read(path):
    mesh = meshio.read(path)
    return mesh.points, np.vstack([block.data for block in mesh.cells if block.type == "tetra"])


class Maille:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        self.notes = []

    def __call__(self, *arguments):
        """Runs it with --json; its summary. Its last argument is the mesh that it makes, which must be valid."""
        done = subprocess.run([self.program, *map(str, arguments), "--json"], capture_output=True, text=True, check=True)
        subprocess.run([self.program, "validate", arguments[-1]], capture_output=True, check=True)
        return json.loads(done.stdout)

    def mesh(self, model, *arguments, out):
        summary = self("mesh", model, *arguments, "-o", self.folder / out)
        clock = summary["cpu_seconds"]
        return sum(clock.values()) - clock["write"], clock["improve"], self.folder / out


def by_peer(program, folder, *arguments):
    """Seconds, points and cells; nothing where the program isn't there or fails."""
    out = folder / f"{program}.npz"
    done = subprocess.run([sys.executable, HERE / "peers.py", program, *map(str, arguments), out],
                          capture_output=True, text=True)
    if done.returncode != 0:
        print(f"{program} failed: {done.stderr.strip().splitlines()[-1]}", file=sys.stderr)
        return None
    data = np.load(out)
    return float(done.stdout.split()[-1]), data["points"], data["cells"]


def at_number(n, make, size):
    """What make(size) gives, cells last, at a size that makes some n cells, as near as a few trials come; and the size."""
    trials = []
    below, above = 0, math.inf  # sizes that are too small, and too large
    for _ in range(4):
        result = make(size)
        if result is None:
            return None, size
        ratio = len(result[-1]) / n
        trials.append((abs(math.log(ratio)), size, result))
        if trials[-1][0] < 0.02:
            break
        below, above = (max(below, size), above) if ratio > 1 else (below, min(above, size))
        size *= ratio ** (1 / 3)
        if not below < size < above:  # Netgen's numbers jump
            size = math.sqrt(below * above)
    _, size, result = min(trials, key=lambda trial: trial[:2])
    return result, size


def compare_scene(maille, scene, n, peers):
    model = HERE / "scenes" / f"{scene}.csg"

    def ours(size, *arguments):
        seconds, improving, path = maille.mesh(model, "--size", size, *arguments, out=f"{scene}.vtu")
        return seconds, improving, *read(path)

    (seconds, improving, points, cells), size = at_number(n, ours, 0.1 * (n / 1e5) ** (-1 / 3))
    before = ours(size, "--no-improve")
    row(SCENES[scene], "maille, not improved", before[0], *before[2:])
    row("", f"maille (improvement {improving:.2f} s of it)", seconds, points, cells)
    if scene in VOLUMES:
        errors = [volume(*mesh) / VOLUMES[scene] - 1 for mesh in (before[2:], (points, cells))]
        maille.notes.append(f"{SCENES[scene]}: relative error of the volume {errors[0]:.2e}, improved {errors[1]:.2e}")
    for program in peers:
        result, _ = at_number(n, lambda size: by_peer(program, maille.folder, scene, size), size)
        if result:
            row("", PEERS[program], *result)


def compare_example(maille, path):
    before = maille.mesh(path, "--no-improve", out="before.vtu")
    after = maille.mesh(path, out="after.vtu")
    row(path.stem, "not improved", before[0], *read(before[2]))
    row("", f"improved ({after[1]:.2f} s)", after[0], *read(after[2]))


def compare_cube(maille):
    folder = maille.folder
    start, refined, improved = folder / "cube.msh", folder / "refined.vtu", folder / "improved.vtu"
    geometry = folder / "cube.geo"
    geometry.write_text('SetFactory("OpenCASCADE"); Box(1) = {0,0,0,1,1,1};\n'
                        "Mesh.CharacteristicLengthMin = 0.0465; Mesh.CharacteristicLengthMax = 0.0465;\n")
    subprocess.run(["gmsh", "-3", "-format", "msh22", geometry, "-o", start], capture_output=True, check=True)
    size = ("--size", CUBE_SIZE)
    plain = maille("refine", start, *size, "-o", refined)["cpu_seconds"]
    row("cube, refined", "maille refine", plain["refine"], *read(refined))
    smooth = maille("refine", start, *size, "--smooth", "-o", improved)["cpu_seconds"]
    row("", f"maille refine --smooth (improvement {smooth['improve']:.2f} s of it)",
        smooth["refine"] + smooth["improve"], *read(improved))
    subprocess.run([maille.program, "convert", refined, folder / "refined.msh"], capture_output=True, check=True)
    result = by_peer("gmsh-optimize", folder, folder / "refined.msh")
    if result:
        row("", "maille refine, then Gmsh -optimize", plain["refine"] + result[0], *result[1:])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--maille", default=ROOT / "build/release/maille", type=Path)
    parser.add_argument("--cells", default=100_000, type=int, help="wanted number of cells of each scene")
    parser.add_argument("--peers", nargs="*", choices=list(PEERS), default=list(PEERS))
    parser.add_argument("--folder", default="/tmp/improvement", type=Path)
    parser.add_argument("what", nargs="*", metavar="WHAT")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    maille = Maille(options.maille, options.folder)
    what = options.what or [*SCENES, "examples", "cube"]
    print(HEADER)
    for scene in SCENES:
        if scene in what:
            compare_scene(maille, scene, options.cells, options.peers)
    if "examples" in what:
        for path in sorted((ROOT / "examples").glob("*.csg")):
            compare_example(maille, path)
    if "cube" in what:
        compare_cube(maille)
    print(*maille.notes, sep="\n\n")


if __name__ == "__main__":
    main()
