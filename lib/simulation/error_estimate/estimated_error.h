// Estimates the mesh error of equilibria, motions and modes: by finer elements (finer_solution.h) if affordable, else
// by recovered stresses (lib/fem/stress_recovery.h). Warns of locking that the estimate may miss.
#pragma once

#include <string>
#include <vector>

#include "lib/simulation/error_estimate/finer_solution.h"
#include "lib/simulation/error_estimate/mesh_error.h"

namespace orthodyn {

// Whether finer elements are affordable, the model is on one rank, and its tangent is symmetric.
bool allows_finer_elements(const FemModel& model);

// Estimates the mesh error of a state by finer elements, including the errors of probed fields (MeshError::probed). If
// finer elements cannot be used, returns `recovered`, the estimate by recovered stresses. Sets MeshError::locking_risk.
// `in_motion`: see state_error(). `nodes`: nodes at which errors of the displacement are estimated.
struct StateMeshError {
  MeshError error;
  std::vector<Vec3> displacements = {};  // exact less computed, at `nodes`, m; empty without finer elements
};
StateMeshError estimate_mesh_error(const Scene& scene, const FemModel& model, const State& state, bool in_motion,
                                   const MeshError& recovered, const std::vector<int>& nodes = {});

struct FrequencyErrors {
  std::vector<double> shares;      // relative error of each frequency; positive if it is too high, 0 for zero modes
  bool by_finer_elements = false;  // else by recovered stresses and the difference of lumped and consistent mass
  std::string locking_risk = {};   // as MeshError::locking_risk
  double cpu_seconds = 0;
};
FrequencyErrors frequency_errors_of(const Scene& scene, const FemModel& model, const State& about, const Modes& modes);

// "the mesh is coarse for 2 of 6 frequencies: mode 1 about 33 % too high, ..."; "" if all errors are below kCoarseMesh.
std::string frequency_warning(const FrequencyErrors& errors, int order);

// "the mesh is coarse for 1 of 2 probed stresses ..."; "" if all errors are below kCoarseStress.
std::string stress_warning(const MeshError& error, int order);

// "the mesh error may be larger than estimated: ..."; "" if `locking_risk` is empty.
std::string locking_warning(const std::string& locking_risk);

// Remedy for a coarse mesh: "Use mesh.order: 2 or finer cells".
std::string finer_mesh(int order);

}  // namespace orthodyn
