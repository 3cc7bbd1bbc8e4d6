// The mesh's error of equilibria, motions and modes, and how it was found: by finer elements (finer_solution.h) where
// these can be afforded, else by recovered stresses (lib/fem/stress_recovery.h), with a word on what they may not see.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/simulation/error_estimate/finer_solution.h"
#include "lib/simulation/error_estimate/mesh_error.h"

namespace orthodyn {

// Whether finer elements are affordable: one process holds the model, and they have at most this many unknowns.
inline constexpr double kMostFinerUnknowns = 120'000;
bool is_affordable(const FemModel& model);

// Estimates the mesh's error of a state by finer elements, those of probed fields included (MeshError::probed). If
// finer elements cannot be used, returns `recovered`, the estimate by recovered stresses, with a sentence on the errors
// that it may miss (MeshError::blind). `displacements`: errors at `nodes`, m; empty without finer elements.
struct FoundByFiner {
  MeshError error;
  std::vector<Vec3> displacements = {};  // empty: not found
};
FoundByFiner look_closer(const Scene& scene, const FemModel& model, const State& state, bool in_motion,
                         const MeshError& recovered, const std::vector<int>& nodes = {});

struct FrequencyErrors {
  std::vector<double> shares;      // of each mode that by which it is too high; 0 of those at zero
  bool by_finer_elements = false;  // else by recovered stresses and the difference of lumped and consistent mass
  std::string blind = {};          // as of MeshError
  double cpu_seconds = 0;
};
FrequencyErrors frequency_errors_of(const Scene& scene, const FemModel& model, const State& about, const Modes& modes);

// "the mesh makes mode 1 about 33 % too high, ...", or "" where all are below kCoarseMesh.
std::string frequency_warning(const FrequencyErrors& errors, int order);

// "the mesh is coarse for 1 of 2 probed stresses ...", or "" where all are below kCoarseStress.
std::string stress_warning(const MeshError& error, int order);

// "the mesh's error may be larger than estimated: ...", of MeshError::blind; "" where that is.
std::string blindness_warning(const std::string& blind);

// What would make a mesh's error smaller: "Take mesh.order: 2 or finer cells".
std::string finer_mesh(int order);

}  // namespace orthodyn
