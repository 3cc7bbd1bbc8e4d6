// Two tuning forks side by side, in metres: a shaft, a yoke and two prongs each, of square section, drawn in the plane
// y = 0 and extruded. Cells are small at the inner corners, where the stress is singular and the prongs turn: with
// cells of t there, too, the pitch of the first fork is 9 % too high. Make tuning_fork.msh with
//   gmsh -3 -format msh22 tuning_fork.geo
SetFactory("OpenCASCADE");
t = 0.006;      // thickness of prongs, shaft and yoke
gap = 0.010;    // between the prongs
prong = 0.110;  // their length
shaft = 0.040;
apart = 0.070;  // from fork to fork
corners() = {};

Macro Fork  // around x = x0, as body
  p = newp;
  Point(p) = {x0 - t/2, 0, -t - shaft};
  Point(p + 1) = {x0 + t/2, 0, -t - shaft};
  Point(p + 2) = {x0 + t/2, 0, -t};
  Point(p + 3) = {x0 + gap/2 + t, 0, -t};
  Point(p + 4) = {x0 + gap/2 + t, 0, prong};
  Point(p + 5) = {x0 + gap/2, 0, prong};
  Point(p + 6) = {x0 + gap/2, 0, 0};
  Point(p + 7) = {x0 - gap/2, 0, 0};
  Point(p + 8) = {x0 - gap/2, 0, prong};
  Point(p + 9) = {x0 - gap/2 - t, 0, prong};
  Point(p + 10) = {x0 - gap/2 - t, 0, -t};
  Point(p + 11) = {x0 - t/2, 0, -t};
  corners() += {p, p + 1, p + 2, p + 6, p + 7, p + 11};
  c = newl;
  For k In {0:11}
    Line(c + k) = {p + k, p + (k + 1) % 12};
  EndFor
  outline = newll;
  Curve Loop(outline) = {c:c + 11};
  face = news;
  Plane Surface(face) = {outline};
  body() = Extrude {0, t, 0} {Surface{face}; Layers{1};};
Return

x0 = 0; Call Fork;
Physical Volume("along") = {body(1)};
x0 = apart; Call Fork;
Physical Volume("across") = {body(1)};
Physical Surface("grip") = Surface In BoundingBox{-1, -1, -t - shaft - 1e-6, 1, 1, -t - shaft + 1e-6};

Field[1] = Distance;
Field[1].NodesList = {corners()};
Field[2] = MathEval;
Field[2].F = Sprintf("Min(%g, %g + 0.8*F1)", t, t/12);
Background Field = 2;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
