// Two square bars end to end: "soft", 0.6 m long, and "stiff", 0.4 m, section 0.2 x 0.2 m.
// gmsh -3 two_bars.geo -format msh41 -o two_bars.msh
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 0.6, 0.2, 0.2};
Box(2) = {0.6, 0, 0, 0.4, 0.2, 0.2};
Coherence;
Physical Volume("soft") = {1};
Physical Volume("stiff") = {2};
e = 1e-3;
left() = Surface In BoundingBox {-e, -e, -e, e, 0.2 + e, 0.2 + e};
right() = Surface In BoundingBox {1 - e, -e, -e, 1 + e, 0.2 + e, 0.2 + e};
front() = Surface In BoundingBox {-e, -e, -e, 1 + e, e, 0.2 + e};
bottom() = Surface In BoundingBox {-e, -e, -e, 1 + e, 0.2 + e, e};
Physical Surface("left") = {left()};
Physical Surface("right") = {right()};
Physical Surface("front") = {front()};
Physical Surface("bottom") = {bottom()};
Mesh.MeshSizeMin = 0.12;
Mesh.MeshSizeMax = 0.12;
