// Two boxes of different materials with a bar along their common edges; hexahedra.
SetFactory("Built-in");
Point(1) = {0, 0, 0}; Point(2) = {2, 0, 0}; Point(3) = {2, 1, 0}; Point(4) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 4; Transfinite Curve {2, 4} = 3; Transfinite Surface {1}; Recombine Surface {1};
low[] = Extrude {0, 0, 1} { Surface{1}; Layers{2}; Recombine; };
high[] = Extrude {0.5, 0, 1.5} { Surface{low[0]}; Layers{3}; Recombine; };
Physical Volume("plate") = {low[1]};
Physical Volume("projectile", 7) = {high[1]};
Physical Curve("rebar") = {1};
Physical Surface("bottom") = {1};
