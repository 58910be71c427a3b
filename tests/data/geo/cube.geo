# A cube of six planes, with a hollow ball in it.
algebraic3d

solid left = plane (0, 0, 0; -1, 0, 0) -bcname=inlet;
solid right = plane (1, 1, 1; 1, 0, 0) -bc=2;
solid cube = left and right
         and plane (0, 0, 0; 0, 0, -1)
         and plane (0, 0, 0; 0, -1, 0)
         and plane (1, 1, 1; 0, 0, 1)
         and plane (1, 1, 1; 0, 1, 0) -bcname=walls;
solid ball = sphere (0.5, 0.5, 0.5; 0.3);
solid main = cube and not ball -maxh=0.2;

tlo main -material=air -col=[1,0,0.5] -transparent;
