// What the next finer elements (finer_model.h) make of a state or a mode that was computed: an estimate of the mesh's
// error that sees what recovered stresses cannot, such as locking, where all elements are wrong in the same way. The
// coarse solution is tested with the finer elements' functions (a hierarchical estimate; Bank & Smith 1993, SIAM J.
// Numer. Anal. 30, 921), and what these find is enlarged by what still finer ones would find beyond it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lib/analysis/modes.h"
#include "lib/simulation/error_estimate/finer_model.h"

namespace orthodyn {

// For each output of the model, such as nodal_stress, the nodes at which its error is wanted.
using NodesByField = std::map<std::string, std::vector<int>>;

// Norms over the components of a field at a node, in the field's unit. `scale`: the norm of the field there, at least a
// tenth of its largest norm in the body.
struct FieldError {
  double scale = 0, error = 0;
};

struct StateError {
  double energy = 0;                                      // J, elastic, of the error
  std::vector<Vec3> displacements;                        // m, true less computed, of the nodes that are asked for
  std::map<std::string, std::vector<FieldError>> fields;  // for each wanted node; fields without values are absent
};

// The response of the finer elements to what is out of balance in them: of a linear model in equilibrium the difference
// of the two solutions, of another one the first step of Newton's method towards the finer one. In motion the body has
// the acceleration that its forces give it. Throws RunError where the stiffness is not positive definite, or memory
// does not suffice, RecoverableError where the finer elements have no forces.
StateError state_error(const FinerModel& finer, const State& coarse, bool in_motion, const std::vector<int>& nodes,
                       const NodesByField& fields = {});

// Of each mode the share by which its frequency is too high; 0 of those at zero. By the Rayleigh quotients
// (Rayleigh-Ritz) of the shapes and of the finer body's responses to their inertia. Throws as above.
std::vector<double> frequency_errors(const FinerModel& finer, const State& about, const Modes& modes);

}  // namespace orthodyn
