"""Meshes a scene by Gmsh or Netgen, or betters a mesh by Gmsh's optimiser, for compare.py.

Usage: peers.py PROGRAM SCENE SIZE OUT.npz     PROGRAM is gmsh, gmsh-hxt or netgen
       peers.py gmsh-optimize IN.msh OUT.npz
Prints the seconds of processor time that meshing, or optimisation alone, took. Netgen's optimiser isn't in
Debian's Gmsh.
"""

import itertools
import resource
import sys

import numpy as np


class Clock:
    @staticmethod
    def now():
        usage = resource.getrusage(resource.RUSAGE_SELF)
        return usage.ru_utime + usage.ru_stime

    def __init__(self):
        self.begin = self.now()

    def seconds(self):
        return self.now() - self.begin


# The four scenes, as in scenes/*.csg.
HOLES = list(itertools.product((0.5, 1.5, 2.5), repeat=3))


def gmsh_scene(gmsh, scene):
    occ = gmsh.model.occ
    if scene == "box_cylinder":
        occ.cut([(3, occ.addBox(-1, -1, -1, 2, 2, 2))], [(3, occ.addCylinder(0, 0, -2, 0, 0, 4, 0.5))])
    elif scene == "sphere_box":
        occ.fuse([(3, occ.addSphere(0, 0, 0, 1))], [(3, occ.addBox(0, 0, 0, 1.2, 1.2, 1.2))])
    elif scene == "cylinders_sphere":
        rods = [(3, occ.addCylinder(*(-1.5 * np.eye(3)[axis]), *(3 * np.eye(3)[axis]), 0.4)) for axis in range(3)]
        union, _ = occ.fuse(rods[:1], rods[1:])
        occ.cut(union, [(3, occ.addSphere(0, 0, 0, 0.6))])
    else:
        occ.cut([(3, occ.addBox(0, 0, 0, 3, 3, 3))], [(3, occ.addSphere(*at, 0.35)) for at in HOLES])
    occ.synchronize()


def netgen_scene(csg, scene):
    def box(a, b):
        return csg.OrthoBrick(csg.Pnt(*a), csg.Pnt(*b))

    def rod(axis, r):
        end = 2 * np.eye(3)[axis]
        return csg.Cylinder(csg.Pnt(*-end), csg.Pnt(*end), r)

    if scene == "box_cylinder":
        return box([-1] * 3, [1] * 3) - rod(2, 0.5)
    if scene == "sphere_box":
        return csg.Sphere(csg.Pnt(0, 0, 0), 1) + box([0] * 3, [1.2] * 3)
    if scene == "cylinders_sphere":
        rods = rod(0, 0.4) + rod(1, 0.4) + rod(2, 0.4)
        return rods * box([-1.5] * 3, [1.5] * 3) - csg.Sphere(csg.Pnt(0, 0, 0), 0.6)
    solid = box([0] * 3, [3] * 3)
    for at in HOLES:
        solid = solid - csg.Sphere(csg.Pnt(*at), 0.35)
    return solid


def gmsh_arrays(gmsh):
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    place = np.zeros(int(tags.max()) + 1, np.int64)
    place[tags.astype(np.int64)] = np.arange(len(tags))
    _, nodes = gmsh.model.mesh.getElementsByType(4)
    return coordinates.reshape(-1, 3), place[nodes.astype(np.int64)].reshape(-1, 4)


def start_gmsh():
    import gmsh

    gmsh.initialize()
    gmsh.option.setNumber("General.Verbosity", 1)
    gmsh.option.setNumber("General.NumThreads", 1)
    return gmsh


def by_gmsh(program, scene, size):
    gmsh = start_gmsh()
    clock = Clock()
    gmsh_scene(gmsh, scene)
    gmsh.option.setNumber("Mesh.CharacteristicLengthMin", size)
    gmsh.option.setNumber("Mesh.CharacteristicLengthMax", size)
    gmsh.option.setNumber("Mesh.Algorithm3D", 10 if program == "gmsh-hxt" else 1)
    gmsh.option.setNumber("Mesh.Optimize", 1)
    gmsh.model.mesh.generate(3)
    return clock.seconds(), *gmsh_arrays(gmsh)


def by_netgen(scene, size):
    import netgen.meshing
    from netgen import csg

    netgen.meshing.SetMessageImportance(0)
    clock = Clock()
    geometry = csg.CSGeometry()
    geometry.Add(netgen_scene(csg, scene))
    mesh = geometry.GenerateMesh(maxh=size)
    seconds = clock.seconds()
    cells = np.array([[v.nr - 1 for v in element.vertices] for element in mesh.Elements3D()])
    points = np.array([list(p.p) for p in mesh.Points()])
    return seconds, points, cells[:, [0, 1, 3, 2]]


def optimize(path):
    gmsh = start_gmsh()
    gmsh.open(path)
    clock = Clock()
    gmsh.model.mesh.optimize("", force=True)
    return clock.seconds(), *gmsh_arrays(gmsh)


def main():
    program, *arguments = sys.argv[1:-1]
    if program == "gmsh-optimize":
        seconds, points, cells = optimize(*arguments)
    elif program == "netgen":
        seconds, points, cells = by_netgen(arguments[0], float(arguments[1]))
    else:
        seconds, points, cells = by_gmsh(program, arguments[0], float(arguments[1]))
    np.savez(sys.argv[-1], points=points, cells=cells)
    print(seconds)


if __name__ == "__main__":
    main()
