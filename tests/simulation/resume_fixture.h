// Common parts of the tests of resumed runs.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/simulation/result_reader.h"

namespace orthodyn {

// A soft damped beam under a harmonic load: damping erases the past, so that the error of a restart does not
// accumulate.
inline const char* const kBeam = R"(
mesh: {type: box, size: [1, 0.2, 0.2], cells: [6, 2, 2], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e5, nu: 0.3}}
damping: {stiffness: 0.03}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0, 5], factor: {type: sine, frequency: 1.5}}]
checkpoint: {every: 0.02}
output:
  frames: 40
  momentum: true
  probes: {tip: {at: [1, 0.1, 0.1]}}
)";
inline constexpr double kRtol = 1e-4;
inline const char* const kBdf = "time: {end: 25}\nintegrator: {type: cvode_bdf, rtol: 1e-4}\n";
inline const char* const kFixedStep = "time: {end: 4}\nintegrator: {type: arkode_dirk, step: 0.02, rtol: 1e-8}\n";

// Root mean square difference over the body and the frames, the larger of displacement and velocity, relative to the
// scales of the integrator (as rtol is).
double difference(const fs::path& a, const fs::path& b);

// Checks that rows are at the same times, none lost or repeated.
void expect_same_times(const fs::path& a, const fs::path& b);

class Resume : public InFolder {
 protected:
  nlohmann::json record(const std::string& name) const {
    return nlohmann::json::parse(read_text(folder_ / name / "run.json"));
  }
};

}  // namespace orthodyn
