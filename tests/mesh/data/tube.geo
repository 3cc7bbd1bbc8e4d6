// A quarter of a tube, 1 to 2 m, and 1 m long: hexahedra (-setnumber hexahedra 1) or wedges of second order.
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
Point(1) = {1, 0, 0}; Point(2) = {2, 0, 0}; Point(3) = {0, 2, 0}; Point(4) = {0, 1, 0}; Point(5) = {0, 0, 0};
Line(1) = {1, 2}; Circle(2) = {2, 5, 3}; Line(3) = {3, 4}; Circle(4) = {4, 5, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 2; Transfinite Curve {2, 4} = 4;
Transfinite Surface {1};
If (hexahedra)
  Recombine Surface {1};
EndIf
body[] = Extrude {0, 0, 1} { Surface{1}; Layers{1}; Recombine; };
Physical Volume("tube") = {body[1]};
Physical Surface("end") = {1};
