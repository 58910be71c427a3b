algebraic3d
# One cut off above and below, one up to its apex, one that narrows downwards.
solid frustum = cone (0, 0, 0; 2; 0, 0, 1; 1.5)
    and plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 2; 0, 0, 1);
solid pointed = cone (5, 0, 3; 0; 5, 0, 0; 1) and plane (5, 0, 0; 0, 0, -1);
solid hanging = cone (10, 0, 0; 0.5; 10, 0, 2; 1.5)
    and plane (10, 0, 0; 0, 0, -1) and plane (10, 0, 2; 0, 0, 1);
tlo frustum; tlo pointed; tlo hanging;
