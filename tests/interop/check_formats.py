"""Checks our mesh files against meshio, Gmsh and CalculiX: what we write they read, with the same groups, and the other way
round. Usage: check_formats.py MESH_PROBE meshio|gmsh|ccx. Exit status 77 where that program isn't installed."""
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
    return bool(shutil.which(partner) or importlib.util.find_spec(partner))


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
        {"meshio": check_meshio, "gmsh": check_gmsh, "ccx": check_ccx}[PARTNER](folder, facts)
