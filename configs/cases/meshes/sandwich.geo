// A quarter of a sandwich plate, 5 in by 5 in: faces of 0.028 in, a core of 0.75 in; lengths in inches.
// gmsh -3 sandwich.geo -format msh41 -o sandwich.msh
n = 12;
Point(1) = {0, 0, 0};
Point(2) = {5, 0, 0};
Point(3) = {5, 5, 0};
Point(4) = {0, 5, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 2, 3, 4} = n + 1;
Transfinite Surface {1};
lower[] = Extrude {0, 0, 0.028} { Surface{1}; Layers{1}; };
core[] = Extrude {0, 0, 0.75} { Surface{lower[0]}; Layers{2}; };
upper[] = Extrude {0, 0, 0.028} { Surface{core[0]}; Layers{1}; };
Physical Volume("faces") = {lower[1], upper[1]};
Physical Volume("core") = {core[1]};
Physical Surface("y0") = {lower[2], core[2], upper[2]};
Physical Surface("x1") = {lower[3], core[3], upper[3]};
Physical Surface("y1") = {lower[4], core[4], upper[4]};
Physical Surface("x0") = {lower[5], core[5], upper[5]};
Physical Surface("top") = {upper[0]};
