// Two tuning forks side by side, in metres: a shaft, a yoke and two prongs each, of square section.
// gmsh -3 -format msh22 tuning_fork.geo
SetFactory("OpenCASCADE");
t = 0.006;      // thickness of prongs, shaft and yoke
gap = 0.010;    // between the prongs
prong = 0.110;  // their length
shaft = 0.040;
apart = 0.070;  // from fork to fork

Macro Parts  // of the fork around x = x0, as volumes v, v + 1, v + 2, v + 3; prongs along z
  Box(v) = {x0 - gap/2 - t, 0, 0, t, t, prong};
  Box(v + 1) = {x0 + gap/2, 0, 0, t, t, prong};
  Box(v + 2) = {x0 - gap/2 - t, 0, -t, gap + 2*t, t, t};
  Box(v + 3) = {x0 - t/2, 0, -t - shaft, t, t, shaft};
Return

v = 11; x0 = 0; Call Parts;
v = 21; x0 = apart; Call Parts;
BooleanUnion(1) = { Volume{11}; Delete; }{ Volume{12:14}; Delete; };
BooleanUnion(2) = { Volume{21}; Delete; }{ Volume{22:24}; Delete; };
Physical Volume("along") = {1};
Physical Volume("across") = {2};
Physical Surface("grip") = Surface In BoundingBox{-1, -1, -t - shaft - 1e-6, 1, 1, -t - shaft + 1e-6};
Mesh.MeshSizeMin = t;
Mesh.MeshSizeMax = t;
