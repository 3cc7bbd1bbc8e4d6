// Scenes for tests with several MPI ranks. Each has a feature that a partition may cut through.
#pragma once

#include <string>
#include <vector>

namespace orthodyn {

struct SharedScene {
  std::string name, yaml;
};

inline const char* const kSharedHead = R"(
materials:
  wood: {type: orthotropic, density: 600, young: [1.0e7, 8.0e5, 5.0e5], nu12: 0.37, nu23: 0.47, nu13: 0.4,
         g12: 7.0e5, g23: 4.0e4, g13: 6.0e5, expansion: {moisture: [1e-3, 4e-3, 8e-3]}}
time: {end: 0.2}
)";

inline std::vector<SharedScene> shared_scenes() {
  const std::string box = "mesh: {type: box, size: [1, 0.2, 0.1], cells: [10, 3, 2], order: 1}\n";
  const std::string fine = "mesh: {type: box, size: [1, 0.2, 0.1], cells: [6, 2, 1], order: 2}\n";
  const std::string head = kSharedHead;
  return {{"clamped", box + head + R"(
clamps: [{name: wall, surface: x0}]
gravity: [0, 0, -9.81]
damping: {stiffness: 2.0e-3, mass: 0.3}
loads: [{surface: x1, traction: [0, 200, "100 * y"]}]
output: {reactions: true}
)"},
          {"quadratic", fine + head + R"(
clamps: [{surface: x0, components: [x, z]}, {nearest: [0, 0, 0]}]
gravity: [0, 0, -9.81]
initial: {noise: {amplitude: 1.0e-4, seed: 3}}
)"},
          {"moved", box + head + R"(
motions: [{name: hand, surface: y0, rotation: {axis: [0, 1, 0], angle: 0.3 rad}, factor: {type: sine, frequency: 3}}]
damping: {stiffness: 1.0e-3}
output: {reactions: true}
)"},
          {"touching", box + head + R"(
initial: {velocity: [0, 0, -1], spin: [0, 2, 0]}
gravity: [0, 0, -9.81]
terms: [{type: ground_contact, point: [0, 0, -0.005], stiffness: 1.0e7}]
)"},
          {"touching_quadratic", fine + head + R"(
initial: {velocity: [0.3, 0, -1], spin: [0, 2, 0]}
terms: [{type: ground_contact, point: [0, 0, -0.005], stiffness: 1.0e7, friction: 0.3}]
)"},
          {"touching_hexahedra",
           "mesh: {type: box, size: [1, 0.2, 0.1], cells: [6, 2, 2], elements: hexahedra}\n" + head + R"(
initial: {velocity: [0.3, 0, -1], spin: [0, 2, 0]}
terms: [{type: ground_contact, point: [0, 0, -0.005], stiffness: 1.0e7, friction: 0.3}]
)"},
          {"tied", box + head + R"(
clamps: [{surface: z0}]
terms:
  - {type: spring, between: [[0.1, 0, 0], [1, 0.2, 0.1]], stiffness: 300}
  - {type: dashpot, between: [[0.2, 0.2, 0], [0.9, 0, 0.1]], coefficient: 5}
  - {type: spring, surface: x1, anchor: [1.5, 0.1, 0.05], stiffness: 500}
  - {type: pressure, surface: z1, pressure: "1000 + 1000 * x"}
)"},
          {"turned", box + head + R"(
regions: {body: {material: wood, axes: {type: cylindrical, point: [0, 0, -0.3], axis: [1, 0, 0]}}}
clamps: [{box: {min: [-1, -1, -1], max: [0.45, 1, 1]}}]
gravity: [0, 0, -9.81]
)"},
          {"swollen", box + head + R"(
regions: {body: {material: wood, axes: {type: cylindrical, point: [0, 0, -0.3], axis: [1, 0, 0]}}}
clamps: [{surface: x0}]
moisture: {formula: '3*x*(1 + y)*sin(20*t)'}
)"},
          // Plies that two cells share.
          {"layers", "mesh: {type: box, size: [1, 0.2, 0.04], cells: [6, 2, 2], elements: hexahedra}\n" + head + R"(
regions: {body: {layup: [[wood, 0, 0.5 cm], [wood, 60 deg, 3 cm], [wood, 0, 0.5 cm]]}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0, -1]}]
)"},
          {"bricks",
           "mesh: {type: box, size: [1, 0.2, 0.1], cells: [6, 2, 2], elements: hexahedra, order: 1}\n" + head + R"(
initial: {velocity: [0, 0, -1]}
terms: [{type: ground_contact, point: [0, 0, -0.005], stiffness: 1.0e7}]
)"},
          {"wedges", "mesh: {type: box, size: [1, 0.2, 0.1], cells: [4, 2, 1], elements: wedges_18}\n" + head + R"(
clamps: [{surface: x0}]
gravity: [0, 0, -9.81]
terms: [{type: pressure, surface: z1, pressure: "1000 + 1000 * x"}]
)"},
          // Hexahedra of 27 nodes beside wedges of 18.
          {"kinds",
           "mesh: {type: gmsh, file: " ORTHODYN_SOURCE_DIR "/tests/mesh/data/bricks_full_22.msh, scale: 0.1}\n" + head +
               R"(
regions: {left: {material: wood}, right: {material: wood}}
clamps: [{surface: clamped}]
gravity: [0, 0, -9.81]
)"},
          // Elements that project their volume strain.
          {"rubber", R"(
mesh: {type: box, size: [1, 0.2, 0.1], cells: [4, 2, 1], elements: hexahedra_27}
time: {end: 0.2}
materials: {rubber: {type: isotropic, density: 1000, young: 5.0e4, nu: 0.48}}
clamps: [{surface: x0}]
gravity: [0, 0, -9.81]
damping: {stiffness: 1.0e-3}
)"},
          // Five elements, so that some of seven ranks have none.
          {"small", "mesh: {type: box, size: [1, 0.2, 0.1], cells: [1, 1, 1], order: 1}\n" + head + R"(
clamps: [{surface: x0}]
gravity: [0, 0, -9.81]
damping: {stiffness: 2.0e-3}
)"}};
}

}  // namespace orthodyn
