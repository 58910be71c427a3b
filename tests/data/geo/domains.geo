algebraic3d
# Inclusions in a block; all share their surfaces.
solid p1 = plane (0, 0, 0; 0, 0, -1);
solid p2 = plane (1, 1, 1; 0, 0, 1);
solid block = p1 and p2
    and plane (0, 0, 0; 0, -1, 0) and plane (1, 1, 1; 0, 1, 0)
    and plane (0, 0, 0; -1, 0, 0) and plane (1, 1, 1; 1, 0, 0) -bc=1;
solid fibre = cylinder (0.5, 0.5, 0; 0.5, 0.5, 1; 0.2);
solid seed = sphere (0.8, 0.8, 0.5; 0.12) or sphere (0.2, 0.2, 0.5; 0.15);
solid inner = block and fibre;
solid matrix = block and not fibre and not seed -maxh=0.15;
tlo seed -material=quartz;
tlo inner -material=glass;
tlo matrix -material=resin;
boundarycondition p2 inner 7;
boundaryconditionname p1 matrix ground;
singular edge p1 p2 -factor=1;
