"""Checks our mesh files against meshio, Gmsh, VTK, DOLFINx and CalculiX: what we write they read, with the same groups, and
the other way round. Usage: check_formats.py MESH_PROBE meshio|gmsh|vtk|dolfinx|ccx. Exit status 77 where that program isn't
installed."""
import importlib.util
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile

import numpy as np

KINDS = {"vertex": 0, "line": 1, "triangle": 2, "tetra": 3}


def same(what, got, wanted):
    if got != wanted:
        sys.exit(f"{what}: {got} instead of {wanted}")


def close(what, got, wanted):
    if not math.isclose(got, wanted, rel_tol=1e-12):
        sys.exit(f"{what}: {got} instead of {wanted}")


def probe(*arguments):
    return subprocess.run([PROBE, *map(str, arguments)], check=True, capture_output=True, text=True).stdout


def info(path):
    return json.loads(probe("info", path))


def set_sizes(facts):
    return {(s["dimension"], s["name"]): s["size"] for s in facts["sets"] if s["size"] > 0}


def volume_of(points, tets):
    a, b, c, d = (points[tets[:, i]] for i in range(4))
    return float(np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a).sum() / 6)


def is_installed(partner):
    module = "vtkmodules" if partner == "vtk" else partner
    return bool(shutil.which(partner) or importlib.util.find_spec(module))


# ---- meshio ---------------------------------------------------------------------------------------------------------
def check_counts(name, mesh, facts):
    same(f"vertices of {name}", len(mesh.points), facts["vertices"])
    tets = np.vstack([b.data for b in mesh.cells if b.type == "tetra"])
    same(f"tetrahedra of {name}", len(tets), facts["cells"])
    close(f"volume of {name}", volume_of(mesh.points, tets), facts["volume"])
    return tets


def check_fields(name, mesh, tets):
    same(f"field x of {name}", mesh.point_data["x"].tolist(), mesh.points[:, 0].tolist())
    centres = np.vstack([d for b, d in zip(mesh.cells, mesh.cell_data["centre"]) if b.type == "tetra"])
    same(f"field centre of {name}", bool(np.allclose(centres, mesh.points[tets].mean(axis=1), atol=1e-14)), True)


def check_meshio(folder, facts):
    import meshio

    for name in ("sample.vtu", "sample41.msh", "sample22.msh"):
        mesh = meshio.read(folder / name)
        tets = check_counts(name, mesh, facts)
        if name != "sample22.msh":
            check_fields(name, mesh, tets)

    # In .vtu a set is a field over all cells; the dimension of those that are 1 is its kind.
    mesh = meshio.read(folder / "sample.vtu")
    sizes = {}
    for k, block in enumerate(mesh.cells):
        for s in facts["sets"]:
            if s["dimension"] == KINDS[block.type]:
                key = (s["dimension"], s["name"])
                sizes[key] = sizes.get(key, 0) + int(mesh.cell_data[s["name"]][k].sum())
    same("sets of sample.vtu", {k: n for k, n in sizes.items() if n}, set_sizes(facts))

    # In 4.1 groups are sets of cells by name. It has no way to tell groups of one name and several dimensions apart.
    mesh = meshio.read(folder / "sample41.msh")
    for s in facts["sets"]:
        if s["size"] == 0 or s["name"] == "same":
            continue
        size = sum(len(c) for c in mesh.cell_sets[s["name"]])
        same(f"group {s['name']} of sample41.msh", size, s["size"])

    # In 2.2 faces, edges and vertices are there once for each group; a cell once.
    mesh = meshio.read(folder / "sample22.msh")
    for s in facts["sets"]:
        if s["size"] == 0 or s["name"] == "same" or s["dimension"] == 3:
            continue
        tag = mesh.field_data[s["name"]][0]
        blocks = zip(mesh.cells, mesh.cell_data["gmsh:physical"])
        size = sum(int((p == tag).sum()) for b, p in blocks if KINDS[b.type] == s["dimension"])
        same(f"group {s['name']} of sample22.msh", size, s["size"])

    # The other way round.
    mesh = meshio.read(folder / "sample.vtu")
    for name, options in (
        ("back.vtu", {}), ("plain.vtu", {"compression": None}), ("text.vtu", {"binary": False}),
        ("back22.msh", {"file_format": "gmsh22"}), ("text22.msh", {"file_format": "gmsh22", "binary": False}),
        ("back41.msh", {"file_format": "gmsh"}), ("back.mesh", {}),
    ):
        if name.endswith("vtu"):
            meshio.write(folder / name, mesh, **options)
        else:
            tets = np.vstack([b.data for b in mesh.cells if b.type == "tetra"])
            meshio.write(folder / name, meshio.Mesh(mesh.points, [("tetra", tets)]), **options)
        got = info(folder / name)
        same(f"cells of {name}", got["cells"], facts["cells"])
        same(f"vertices of {name}", got["vertices"], facts["vertices"])
        if name.endswith("vtu"):
            same(f"sets of {name}", set_sizes(got), set_sizes(facts))
    for name in ("sample.stl", "sample.obj", "sample.off", "sample.ply"):
        triangles = sum(len(b.data) for b in meshio.read(folder / name).cells if b.type == "triangle")
        same(f"triangles of {name}", triangles, 2 * 6 * 3 * 3)


# ---- Gmsh -----------------------------------------------------------------------------------------------------------
def groups_of_gmsh(gmsh):
    sizes = {}
    for dimension, tag in gmsh.model.getPhysicalGroups():
        name = gmsh.model.getPhysicalName(dimension, tag)
        n = 0
        for entity in gmsh.model.getEntitiesForPhysicalGroup(dimension, tag):
            n += sum(len(tags) for tags in gmsh.model.mesh.getElements(dimension, entity)[1])
        sizes[(dimension, name)] = n
    return sizes


def check_gmsh(folder, facts):
    import gmsh

    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    wanted = set_sizes(facts)

    gmsh.open(str(folder / "sample41.msh"))
    same("nodes in Gmsh", len(gmsh.model.mesh.getNodes()[0]), facts["vertices"])
    same("tetrahedra in Gmsh", len(gmsh.model.mesh.getElementsByType(4)[0]), facts["cells"])
    got = groups_of_gmsh(gmsh)
    in_sets = got.pop((3, "(no set)"))
    same("groups in Gmsh", got, wanted)
    same("cells outside sets", 0 < in_sets < facts["cells"], True)
    same("views in Gmsh", len(gmsh.view.getTags()), len(facts["properties"]))
    # What Gmsh writes of it we read, in every version and encoding. (2.2 repeats elements, which come together again.)
    for version, binary in ((4.1, 0), (4.1, 1), (2.2, 0), (2.2, 1)):
        name = f"gmsh{version}{binary}.msh"
        gmsh.option.setNumber("Mesh.MshFileVersion", version)
        gmsh.option.setNumber("Mesh.Binary", binary)
        gmsh.write(str(folder / name))
        back = info(folder / name)
        same(f"cells of {name}", back["cells"], facts["cells"])
        same(f"sets of {name}", set_sizes(back), wanted)
        close(f"volume of {name}", back["volume"], facts["volume"])

    gmsh.clear()
    gmsh.open(str(folder / "sample22.msh"))
    same("tetrahedra of 2.2 in Gmsh", len(gmsh.model.mesh.getElementsByType(4)[0]), facts["cells"])

    # Two boxes with a common face, its edge and a corner, some in groups without names.
    gmsh.clear()
    occ = gmsh.model.occ
    occ.addBox(0, 0, 0, 1, 1, 1)
    occ.addBox(1, 0, 0, 1, 1, 1)
    occ.fragment([(3, 1)], [(3, 2)])
    occ.synchronize()
    model = gmsh.model
    inner = [t for _, t in model.getEntitiesInBoundingBox(0.9, -0.1, -0.1, 1.1, 1.1, 1.1, 2)]
    rim = [t for _, t in model.getEntitiesInBoundingBox(0.9, -0.1, -0.1, 1.1, 1.1, 1.1, 1)]
    model.setPhysicalName(3, model.addPhysicalGroup(3, [1]), "left")
    model.setPhysicalName(3, model.addPhysicalGroup(3, [1, 2]), "both")
    model.setPhysicalName(2, model.addPhysicalGroup(2, inner), "between")
    model.addPhysicalGroup(1, rim, 77)
    model.addPhysicalGroup(0, [1], 5)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.3)
    model.mesh.generate(3)
    for version, binary in ((4.1, 0), (4.1, 1), (2.2, 0), (2.2, 1)):
        name = f"boxes{version}{binary}.msh"
        gmsh.option.setNumber("Mesh.MshFileVersion", version)
        gmsh.option.setNumber("Mesh.Binary", binary)
        gmsh.write(str(folder / name))
        back = info(folder / name)
        measures = {(s["dimension"], s["name"]): s["measure"] for s in back["sets"]}
        same(f"groups of {name}", set(measures), {(3, "left"), (3, "both"), (2, "between"), (1, "group77"), (0, "group5")})
        for group, measure in (((3, "left"), 1), ((3, "both"), 2), ((2, "between"), 1), ((1, "group77"), 4), ((0, "group5"), 1)):
            close(f"measure of {group} in {name}", measures[group], measure)
    gmsh.finalize()


# ---- VTK ------------------------------------------------------------------------------------------------------------
VTK_DIMENSIONS = {1: 0, 3: 1, 5: 2, 10: 3}


def check_vtk(folder, facts):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOExodus import vtkExodusIIReader
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(folder / "sample.vtu"))
    reader.Update()
    grid = reader.GetOutput()
    same("points in VTK", grid.GetNumberOfPoints(), facts["vertices"])
    dimensions = np.array([VTK_DIMENSIONS[grid.GetCellType(i)] for i in range(grid.GetNumberOfCells())])
    same("tetrahedra in VTK", int((dimensions == 3).sum()), facts["cells"])
    sizes = {}
    for s in facts["sets"]:
        flags = vtk_to_numpy(grid.GetCellData().GetArray(s["name"]))
        sizes[(s["dimension"], s["name"])] = int(flags[dimensions == s["dimension"]].sum())
    same("sets in VTK", {k: n for k, n in sizes.items() if n}, set_sizes(facts))
    x = vtk_to_numpy(grid.GetPointData().GetArray("x"))
    same("field x in VTK", x.tolist(), [grid.GetPoint(i)[0] for i in range(grid.GetNumberOfPoints())])
    # What VTK writes of it we read, in all its ways.
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    for name, mode, head in (("text", 0, 32), ("base64", 1, 32), ("base64-64", 1, 64), ("raw", 2, 32), ("raw-64", 2, 64)):
        for compressed in (False, True):
            path = folder / f"vtk-{name}-{compressed}.vtu"
            writer.SetFileName(str(path))
            writer.SetDataMode(mode)
            writer.SetHeaderType(head)
            writer.SetCompressorTypeToZLib() if compressed else writer.SetCompressorTypeToNone()
            writer.Write()
            back = info(path)
            same(f"cells of {path.name}", back["cells"], facts["cells"])
            same(f"sets of {path.name}", set_sizes(back), set_sizes(facts))

    # Exodus: side sets, node sets and element sets by name, with their sizes.
    exodus = vtkExodusIIReader()
    exodus.SetFileName(str(folder / "sample.e"))
    exodus.UpdateInformation()
    kinds = {0: (exodus.NODE_SET, "vertex"), 2: (exodus.SIDE_SET, "face"), 3: (exodus.ELEM_SET, "cell")}
    for dimension, (kind, word) in kinds.items():
        got = {}
        for i in range(exodus.GetNumberOfObjects(kind)):
            got[exodus.GetObjectName(kind, i).split(" Size: ")[0]] = exodus.GetNumberOfEntriesInObject(kind, i)
        wanted = {s["name"]: s["size"] for s in facts["sets"] if s["dimension"] == dimension}
        same(f"{word} sets of sample.e in VTK", got, wanted)
    same("nodes of sample.e in VTK", exodus.GetTotalNumberOfNodes(), facts["vertices"])
    same("elements of sample.e in VTK", exodus.GetTotalNumberOfElements(), facts["cells"])


# ---- DOLFINx --------------------------------------------------------------------------------------------------------
def check_dolfinx(folder, facts):
    """The cube on rollers: its sets arrive as tags of cells and facets."""
    import gmsh
    from dolfinx.io import gmshio
    from mpi4py import MPI

    # Its own read_from_msh, which does this, ends in a name error in 0.5.
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(str(folder / "rollers.msh"))
    groups = {gmsh.model.getPhysicalName(*group): group[1] for group in gmsh.model.getPhysicalGroups()}
    mesh, cells, facets = gmshio.model_to_mesh(gmsh.model, MPI.COMM_WORLD, 0, gdim=3)
    gmsh.finalize()
    same("cells in DOLFINx", mesh.topology.index_map(3).size_global, 6 * 3**3)
    same("tagged cells in DOLFINx", len(cells.indices), 6 * 3**3)
    same("tags of cells in DOLFINx", set(cells.values.tolist()), {groups["steel"]})
    same("tags of facets in DOLFINx", set(facets.values.tolist()), {groups["plate/x+"]})
    pulled = facets.indices
    same("tagged facets in DOLFINx", len(pulled), 2 * 3 * 3)
    mesh.topology.create_connectivity(2, 0)
    corners = {v for f in pulled for v in mesh.topology.connectivity(2, 0).links(f)}
    same("corners of tagged facets in DOLFINx", len(corners), 16)
    same("places of tagged facets in DOLFINx", {mesh.geometry.x[v][0] for v in corners}, {1.0})


# ---- CalculiX -------------------------------------------------------------------------------------------------------
YOUNG, POISSON, PULL = 210e3, 0.3, 42.0


def check_ccx(folder, facts):
    """A cube on rollers, pulled at one side: linear elements have the exact solution. Loads, supports and material
    come from the mesh's sets by name, as the program's user would write them."""
    rollers = "".join(f"ROLLER/{axis}-, {k}, {k}, 0\n" for k, axis in ((1, "X"), (2, "Y"), (3, "Z")))
    (folder / "job.inp").write_text(f"""*INCLUDE, INPUT=rollers.inp
*MATERIAL, NAME=ANY
*ELASTIC
{YOUNG}, {POISSON}
*SOLID SECTION, ELSET=steel, MATERIAL=ANY
*STEP
*STATIC
*BOUNDARY
{rollers}*DSLOAD
plate/x+, P, {-PULL}
*NODE PRINT, NSET=far_vertices
U
*END STEP
""")
    done = subprocess.run(["ccx", "job"], cwd=folder, capture_output=True, text=True)
    if done.returncode != 0 or "*ERROR" in done.stdout:
        sys.exit(f"CalculiX failed: {done.stdout[-2000:]}")
    rows = [line.split() for line in (folder / "job.dat").read_text().splitlines()]
    moved = [[float(x) for x in row[1:]] for row in rows if len(row) == 4 and row[0].isdigit()]
    same("far vertices in CalculiX", len(moved), 16)
    for ux, uy, uz in moved:
        if not math.isclose(ux, PULL / YOUNG, rel_tol=1e-5):
            sys.exit(f"the cube grows by {ux} instead of {PULL / YOUNG}")
        if not (-POISSON * PULL / YOUNG * 1.00001 <= min(uy, uz) and max(uy, uz) <= 1e-12):
            sys.exit(f"the cube narrows by {uy}, {uz}")


if __name__ == "__main__":
    PROBE, PARTNER = sys.argv[1:]
    if not is_installed(PARTNER):
        print(f"skipped: {PARTNER} isn't installed")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        facts = json.loads(probe("write", folder))
        checks = {"meshio": check_meshio, "gmsh": check_gmsh, "vtk": check_vtk, "dolfinx": check_dolfinx, "ccx": check_ccx}
        checks[PARTNER](folder, facts)
