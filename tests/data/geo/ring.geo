algebraic3d
# Half of a ring, and the other half's upper half.
solid ring = torus (0, 0, 0; 0, 0, 1; 3; 1);
solid right = plane (0, 0, 0; -1, 0, 0);
solid above = plane (0, 0, 0; 0, 0, -1);
solid half = ring and right;
solid quarter = ring and not right and above;
tlo half -maxh=0.7;
tlo quarter -maxh=0.7;
