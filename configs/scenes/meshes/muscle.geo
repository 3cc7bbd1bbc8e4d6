// A spindle-shaped muscle bent in the plane y = 0: circles across the curve
//     x = s L, z = 4 h s (1 - s), 0 <= s <= 1,
// of radius r0 + (r1 - r0) sin(pi s)^1.5, and a smooth body through them. The curve goes on through
// the end caps as in muscle.yaml. Metres. Made with: gmsh -3 -format msh41 -o muscle.msh muscle.geo
// muscle_linear.msh, for configs/comparisons/tolerance.yaml: sizes 0.004 to 0.0078, 18 from curvature, order 1.
SetFactory("OpenCASCADE");
L = 0.2; h = 0.024; r0 = 0.006; r1 = 0.022; n = 8;
For k In {0:n}
  s = k / n;
  slope = Atan2(4 * h * (1 - 2 * s), L);
  r = r0 + (r1 - r0) * Sin(Pi * s)^1.5;
  Circle(k + 1) = {0, 0, 0, r, 0, 2 * Pi};
  Rotate {{0, 1, 0}, {0, 0, 0}, Pi / 2 - slope} {Curve{k + 1};}
  Translate {s * L, 0, 4 * h * s * (1 - s)} {Curve{k + 1};}
  Curve Loop(k + 1) = {k + 1};
EndFor
ThruSections(1) = {1:n + 1};
Physical Volume("belly") = {1};
caps() = Surface In BoundingBox {-0.01, -0.01, -0.01, 0.01, 0.01, 0.01};
Physical Surface("origin") = {caps()};
ends() = Surface In BoundingBox {L - 0.01, -0.01, -0.01, L + 0.01, 0.01, 0.01};
Physical Surface("insertion") = {ends()};
Mesh.MeshSizeMin = 0.003; Mesh.MeshSizeMax = 0.02;
Mesh.MeshSizeFromCurvature = 10;
Mesh.ElementOrder = 2;  // curved edges: straight ones leave out 2 % of the body, and 5 % of the motion with it
Mesh.Optimize = 1;
