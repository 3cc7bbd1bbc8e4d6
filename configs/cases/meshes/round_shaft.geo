// A round shaft along x, 0.05 m long, radius 0.05 m.
// gmsh -3 round_shaft.geo -format msh41 -o round_shaft.msh
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0.05, 0, 0, 0.05};
e = 1e-3;
root() = Surface In BoundingBox {-e, -1, -1, e, 1, 1};
Physical Volume("shaft") = {1};
Physical Surface("root") = {root()};
h = 0.0075;
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
