# A pipe's elbow with flanges, in Netgen's language.
algebraic3d

solid quarter = plane (0, 0, 0; -1, 0, 0) and plane (0, 0, 0; 0, -1, 0);
solid bend = torus (0, 0, 0; 0, 0, 1; 5; 1.5) and quarter;
solid hollow = torus (0, 0, 0; 0, 0, 1; 5; 1.1);
solid flanges = (cylinder (5, -1, 0; 5, 1, 0; 2.2) and plane (5, -0.6, 0; 0, -1, 0) and plane (5, 0, 0; 0, 1, 0)
    or cylinder (-1, 5, 0; 1, 5, 0; 2.2) and plane (-0.6, 5, 0; -1, 0, 0) and plane (0, 5, 0; 1, 0, 0))
    and not cylinder (5, -1, 0; 5, 1, 0; 1.1) and not cylinder (-1, 5, 0; 1, 5, 0; 1.1);
solid elbow = bend and not hollow or flanges -maxh=0.5;
tlo elbow -material=iron;
