SetFactory("OpenCASCADE");
Box(1) = {0,0,0,1,1,1};
Box(2) = {1,0,0,1,1,1};
Coherence;
MeshSize{:} = 2;
Physical Volume("left",1) = {1};
Physical Volume("right",2) = {2};
Physical Surface("clamped",3) = {1};
Physical Point("tip",4) = {9};
