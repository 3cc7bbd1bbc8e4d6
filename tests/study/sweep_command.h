// Runs `orthodyn sweep` in a temporary folder on a scene with one unknown.
#pragma once

#include <map>

#include "lib/simulation/output/json.h"
#include "tests/simulation/run_program.h"

namespace orthodyn {

// One node of a cube of one cell moves along x: a damped oscillator (see configs/cases/one_node_damped.yaml).
inline const char* const kOscillator = R"(mesh: {type: box, size: [0.1, 0.1, 0.1], cells: [1, 1, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e6, nu: 0}}
elasticity: {kinematics: linear}
damping: {mass: 0}
loads: [{surface: x1, force: [1, 0, 0]}]
clamps:
  - {surface: x0}
  - {surface: y0}
  - {surface: z0}
  - {nearest: [0.1, 0.1, 0.1], components: [y, z]}
time: {end: 0.02}
integrator: {type: cvode_bdf, rtol: 1e-7, max_order: 5}
output: {probes: {node: {at: [0.1, 0.1, 0.1]}}}
)";

class SweepCommand : public InFolder {
 protected:
  SweepCommand() { write("scene.yaml", kOscillator); }

  CommandResult sweep(const std::string& more = "") const { return orthodyn("sweep s.yaml --no-report " + more); }
  Json table() const { return Json::parse(read_text(folder_ / "out/sweeps/s/sweep.json")); }

  // The table without times and date.
  std::string metrics() const {
    Json t = table();
    for (auto& point : t.at("points")) point.erase("cost");
    return t.at("points").dump();
  }
  std::map<std::string, std::string> results() const {
    std::map<std::string, std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out/sweeps/s/points"))
      if (entry.path().filename() == "result.json") out[entry.path()] = read_text(entry.path());
    return out;
  }
};

inline const char* const kMany = R"(scene: scene.yaml
vary: {materials.soft.young: {from: 1e5, to: 1e7, count: 12, scale: log, name: E}}
quantities:
  far: {quantity: node.displacement.x, take: max}
  hertz: {mode: 1}
)";

}  // namespace orthodyn
