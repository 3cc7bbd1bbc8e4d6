// A strip of two layers, 0.3 x 0.04 m, each 4 mm thick. Make laminate.msh with
//   gmsh -3 -format msh41 laminate.geo
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 0.3, 0.04, 0.004};
Box(2) = {0, 0, 0.004, 0.3, 0.04, 0.004};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }

Physical Volume("lower") = {1};
Physical Volume("upper") = {2};

e = 1e-6;
root() = Surface In BoundingBox{-e, -e, -e, e, 0.04 + e, 0.008 + e};
tip() = Surface In BoundingBox{0.3 - e, -e, -e, 0.3 + e, 0.04 + e, 0.008 + e};
Physical Surface("root") = {root()};
Physical Surface("tip") = {tip()};

Mesh.CharacteristicLengthMin = 0.012;
Mesh.CharacteristicLengthMax = 0.012;
Mesh.Optimize = 1;
Mesh.OptimizeNetgen = 1;
Mesh.SaveAll = 0;
