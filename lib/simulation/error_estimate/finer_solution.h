// Estimates the mesh error of a state or a mode by testing it with finer elements (finer_model.h): a hierarchical
// estimate (Bank & Smith 1993, SIAM J. Numer. Anal. 30, 921), extrapolated to infinitely fine elements. It detects
// errors that recovered stresses cannot detect, such as locking, which affects all elements alike.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lib/analysis/modes.h"
#include "lib/simulation/error_estimate/finer_model.h"

namespace orthodyn {

// For each output, such as nodal_stress, the nodes at which its error is estimated.
using NodesByField = std::map<std::string, std::vector<int>>;

// Error of a field at a node: norms over the field's components, in its unit. `scale`: norm of the field at the node,
// but at least a tenth of its largest norm in the body.
struct FieldError {
  double scale = 0, error = 0;
};

struct StateError {
  double energy = 0;                                      // elastic energy of the error, J
  std::vector<Vec3> displacements;                        // at the requested nodes, exact minus computed, m
  std::map<std::string, std::vector<FieldError>> fields;  // at the requested nodes; fields without values are absent
};

// Estimates the error of a state as the displacement by which the finer elements respond to their residual force. For a
// linear model in equilibrium this is the difference of the two solutions, else the first Newton step towards the finer
// solution. `in_motion`: true if the forces accelerate the body, false in an equilibrium. Throws RunError if the
// stiffness is unsymmetric, if it cannot be factorised, or if memory is insufficient. Throws RecoverableError if the
// finer elements cannot be evaluated, or if their stiffness is not positive definite.
StateError state_error(const FinerModel& finer, const State& coarse, bool in_motion, const std::vector<int>& nodes,
                       const NodesByField& fields = {});

// Relative error of each frequency; positive if the frequency is too high, 0 for zero modes. The frequencies are
// compared with Rayleigh-Ritz values of the finer elements, in the space of the mode shapes and of the responses to the
// residual forces of these shapes. Throws like state_error().
std::vector<double> frequency_errors(const FinerModel& finer, const State& about, const Modes& modes);

}  // namespace orthodyn
