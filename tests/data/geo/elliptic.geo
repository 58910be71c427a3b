algebraic3d
solid cone = ellipticcone (0, 0, 0; 3, 0, 0; 0, 2, 0; 4; 0.5)
    and plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 4; 0, 0, 1);
solid cylinder1 = ellipticcylinder (10, 0, 0; 0, 2, 0; 0, 0, 1)
    and not plane (10, 0, 0; 1, 0, 0) and plane (13, 0, 0; 1, 0, 0);
solid egg = ellipsoid (0, 10, 0; 3, 0, 0; 0, 2, 0; 0, 0, 1);
tlo cone;
tlo cylinder1;
tlo egg;
