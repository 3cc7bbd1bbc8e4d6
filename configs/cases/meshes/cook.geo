// Cook's membrane: 48 mm wide, 44 to 16 mm high, 1 mm thick; lengths in mm.
// gmsh -3 cook.geo -format msh41 -o cook.msh
n = 8;
Point(1) = {0, 0, 0};
Point(2) = {48, 44, 0};
Point(3) = {48, 60, 0};
Point(4) = {0, 44, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 2, 3, 4} = n + 1;
Transfinite Surface {1};
out[] = Extrude {0, 0, 1} { Surface{1}; Layers{1}; };
Physical Volume("membrane") = {out[1]};
Physical Surface("wall") = {out[5]};
Physical Surface("end") = {out[3]};
