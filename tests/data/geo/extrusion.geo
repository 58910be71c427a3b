algebraic3d
curve2d square = (4; 1, 1; 1, -1; -1, -1; -1, 1; 4; 2, 1, 2; 2, 2, 3; 2, 3, 4; 2, 4, 1);
curve2d disc = (8; -1, 0; -1, 1; 0, 1; 1, 1; 1, 0; 1, -1; 0, -1; -1, -1;
    4; 3, 1, 2, 3; 3, 3, 4, 5; 3, 5, 6, 7; 3, 7, 8, 1);
curve3d straight = (2; 0, 0, 0; 0, 10, 0; 1; 2, 1, 2);
curve3d knee = (3; 20, 0, 0; 20, 6, 0; 26, 6, 0; 2; 2, 1, 2; 2, 2, 3);
curve3d bow = (3; 40, 0, 0; 46, 0, 0; 46, 6, 0; 1; 3, 1, 2, 3);
curve3d circle = (8; 65, 0, 0; 65, 5, 0; 60, 5, 0; 55, 5, 0; 55, 0, 0; 55, -5, 0; 60, -5, 0; 65, -5, 0;
    4; 3, 1, 2, 3; 3, 3, 4, 5; 3, 5, 6, 7; 3, 7, 8, 1);

solid bar = extrusion (straight; square; 0, 0, 1)
    and plane (0, 1, 0; 0, -1, 0) and plane (0, 9, 0; 0, 1, 0);
solid angle = extrusion (knee; square; 0, 0, 1);
solid pipe = extrusion (bow; disc; 0, 0, 1);
solid hoop = extrusion (circle; disc; 0, 0, 1);
tlo bar; tlo angle; tlo pipe; tlo hoop;
