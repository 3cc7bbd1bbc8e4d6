// A top of revolution about z: a cone that stands on its (blunted) tip, a thick rim, a stem. Largest
// radius 0.1 m, height 0.2 m.
// gmsh -3 spinning_top.geo -format msh41 -o spinning_top.msh
SetFactory("OpenCASCADE");
Cone(1) = {0, 0, 0, 0, 0, 0.09, 0.02, 0.1};
Cylinder(2) = {0, 0, 0.09, 0, 0, 0.03, 0.1};
Cylinder(3) = {0, 0, 0.12, 0, 0, 0.08, 0.02};
top() = BooleanUnion { Volume{1}; Delete; } { Volume{2, 3}; Delete; };
Physical Volume("top") = {top()};
Mesh.MeshSizeMin = 0.025;
Mesh.MeshSizeMax = 0.025;
