// Williams' toggle: two slightly inclined beams with a rigid joint at the apex. gmsh -3 -order 2 -format msh22 toggle.geo
inch = 0.0254;
a = 12.943 * inch;   // half the span
rise = 0.386 * inch;
width = 0.753 * inch;
depth = 0.243 * inch;
n = 16;              // elements along each half

Point(1) = {0, 0, 0};
Point(2) = {a, 0, rise};
Point(3) = {2 * a, 0, 0};
Point(4) = {2 * a, 0, depth};
Point(5) = {a, 0, rise + depth};
Point(6) = {0, 0, depth};
Line(1) = {1, 2};
Line(2) = {2, 5};
Line(3) = {5, 6};
Line(4) = {6, 1};
Line(5) = {2, 3};
Line(6) = {3, 4};
Line(7) = {4, 5};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, -2};
Plane Surface(2) = {2};
Transfinite Curve {1, 3, 5, 7} = n + 1;
Transfinite Curve {2, 4, 6} = 2;
Transfinite Surface {1, 2};
out1[] = Extrude {0, width, 0} { Surface{1}; Layers{1}; };
out2[] = Extrude {0, width, 0} { Surface{2}; Layers{1}; };
Coherence;
Physical Volume("beam") = {1, 2};
Physical Surface("ends") = {out1[5], out2[3]};
