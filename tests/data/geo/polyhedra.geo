algebraic3d
solid brick = orthobrick (0, 0, 0; 3, 2, 1) -bcname=[floor, lid, front, back, west, east];
solid pyramid = polyhedron (
    4, 0, 0; 6, 0, 0; 6, 2, 0; 4, 2, 0; 5, 1, 3 ;;
    4, 3, 2, 1; 1, 2, 5; 2, 3, 5; 3, 4, 5; 4, 1, 5 ) -bc=[1, 2, 3, 4, 5];
tlo brick;
tlo pyramid -material=glass;
