// A bar of 2 by 1 by 1 in two halves, each a physical group; so is the face where it is held.
SetFactory("Built-in");
h = 0.5;
Point(1) = {0, 0, 0, h}; Point(2) = {0, 1, 0, h}; Point(3) = {0, 1, 1, h}; Point(4) = {0, 0, 1, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
left[] = Extrude {1, 0, 0} { Surface{1}; };
right[] = Extrude {1, 0, 0} { Surface{left[0]}; };
Physical Surface("held", 1) = {1};
Physical Volume("steel", 10) = {left[1]};
Physical Volume("brass", 20) = {right[1]};
