algebraic3d
solid peg = cylinder (0, 0, 0; 0, 0, 1; 0.5) and plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 2; 0, 0, 1);
solid row = multitranslate (2, 0, 0; 3; peg);
solid wheel = multirotate (0, 10, 0; 1.5707963267948966, 0, 0; 4; translate (3, 10, 0; peg));
solid lying = rotate (20, 0, 0; 0, 1.5707963267948966, 0; orthobrick (20, 0, 0; 21, 2, 3));
solid ball = translate (30, 0, 0; sphere (0, 0, 0; 1) and not orthobrick (0, -2, -2; 2, 2, 2));
tlo row; tlo wheel; tlo lying; tlo ball;
define constant identprec = 1e-5;
