algebraic3d
boundingbox (-10, -10, -10; 10, 10, 10);
# A tube along a slanting axis, between planes square to it; its bore is a cylinder too.
solid ends = plane (0, 0, 0; -1, -1, 0) and plane (3, 3, 0; 1, 1, 0);
solid tube = cylinder (0, 0, 0; 1, 1, 0; 1) and ends and not cylinder (5, 5, 0; 7, 7, 0; 0.5);
tlo tube -maxh=0.4;
