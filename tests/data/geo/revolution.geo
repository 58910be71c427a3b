algebraic3d
# Closed, of arcs by tangents and by middle points; open, from axis to axis; and a parabola's piece.
curve2d ring = (7; -1, 3; -1, 4; 0, 4; 0, 3; 1, 3; 0, 2; -1, 2;
    4; 3, 1, 2, 3; 4, 3, 4, 5; 4, 5, 4, 6; 3, 6, 7, 1);
curve2d lens = (5; -2, 0; -2, 2; 0, 2; 2, 2; 2, 0; 2; 3, 1, 2, 3; 3, 3, 4, 5);
curve2d peg = (4; 0, 0; 0, 1; 2, 1; 3, 0; 3; 2, 1, 2; 2, 2, 3; 2, 3, 4);
solid hoop = revolution (0, 0, 0; 0, 0, 1; ring);
solid ball = revolution (10, 0, 0; 11, 0, 0; lens);
solid pin = revolution (20, 0, 0; 20, 0, 5; peg) -bcname=[butt, shaft, tip];
tlo hoop; tlo ball; tlo pin;
