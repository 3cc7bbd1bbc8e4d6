// A semicircular arch in the plane y = 0: radius 1 m of its axis, 20 mm thick, 50 mm wide.
// gmsh -3 arch.geo -format msh41 -o arch.msh
Point(1) = {0.99, 0, 0};
Point(2) = {1.01, 0, 0};
Point(3) = {1.01, 0.05, 0};
Point(4) = {0.99, 0.05, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 2, 3, 4} = 2;
Transfinite Surface {1};
out[] = Extrude { {0, -1, 0}, {0, 0, 0}, Pi } { Surface{1}; Layers{96}; };
Physical Volume("arch") = {out[1]};
Physical Surface("ends") = {1, out[0]};
Physical Surface("outside") = {out[3]};
