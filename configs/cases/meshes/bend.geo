// An eighth of a ring in the plane z = 0 with the radius 100 m of its axis and a section of 1 m by 1 m.
// gmsh -3 bend.geo -format msh41 -o bend.msh
Point(1) = {99.5, 0, -0.5};
Point(2) = {100.5, 0, -0.5};
Point(3) = {100.5, 0, 0.5};
Point(4) = {99.5, 0, 0.5};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 2, 3, 4} = 2;
Transfinite Surface {1};
out[] = Extrude { {0, 0, 1}, {0, 0, 0}, Pi/4 } { Surface{1}; Layers{32}; };
Physical Volume("bend") = {out[1]};
Physical Surface("root") = {1};
Physical Surface("tip") = {out[0]};
