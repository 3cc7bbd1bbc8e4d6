// What the next finer elements (finer_model.h) make of a state or a mode that was computed: an estimate of the mesh's
// error that sees what recovered stresses cannot, such as locking, where all elements are wrong in the same way. The
// coarse solution is tested with the finer elements' functions (a hierarchical estimate; Bank & Smith 1993, SIAM J.
// Numer. Anal. 30, 921), and what these find is enlarged by what still finer ones would find beyond it.
#pragma once

#include <string>
#include <vector>

#include "lib/analysis/modes.h"
#include "lib/simulation/errors/finer_model.h"

namespace orthodyn {

// An output of the model at one of its nodes, such as nodal_stress.
struct NodeField {
  std::string field;
  int node = 0;
};

// In the field's unit, as the root of the sum over its components: its size there, or a tenth of the largest in the
// body where that is larger, and the error.
struct FieldError {
  double size = 0, error = 0;
};

struct StateError {
  double energy = 0;                // J, elastic, of the error
  std::vector<Vec3> displacements;  // m, true less computed, of the nodes that are asked for
  std::vector<FieldError> fields;   // of those that are asked for
};

// The response of the finer elements to what is out of balance in them: of a linear model in equilibrium the difference
// of the two solutions, of another one the first step of Newton's method towards the finer one. In motion the body has
// the acceleration that its forces give it. Throws RunError where the stiffness is not positive definite, or memory
// does not suffice, RecoverableError where the finer elements have no forces.
StateError state_error(const FinerModel& finer, const State& coarse, bool in_motion, const std::vector<int>& nodes,
                       const std::vector<NodeField>& fields = {});

// Of each mode the share by which its frequency is too high; 0 of those at zero. By the Rayleigh quotients
// (Rayleigh-Ritz) of the shapes and of the finer body's responses to their inertia. Throws as above.
std::vector<double> frequency_errors(const FinerModel& finer, const State& about, const Modes& modes);

}  // namespace orthodyn
