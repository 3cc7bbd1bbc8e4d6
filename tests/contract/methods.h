// Properties of each integrator that the suite needs and that its keys do not give.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "lib/config/registry.h"
#include "lib/linear/solver.h"
#include "lib/ode/integrator.h"

namespace orthodyn {

// An order that a method can have, and the options that give it, as ", key: value".
struct Variant {
  int order;
  std::string options = "";
};

struct TestedMethod {
  std::vector<Variant> variants;   // at least one
  bool stiff = true;               // steps may be much longer than a stiff time scale
  bool full_path = false;          // accepts linear_solver: klu_full
  bool exact_if_linear = false;    // the error is that of Krylov spaces or of the load's interpolation: no order
  std::string needs = "";          // required options
  bool has_one_estimator = false;  // the local error of its single order
  bool chooses = false;            // selects another integrator; has its own tests
  bool keeps_energy = false;       // to round-off
  bool linear_only = false;        // refuses all other models
};

const std::map<std::string, TestedMethod>& tested_methods();
const TestedMethod& tested(const std::string& integrator);

bool has_key(const std::string& integrator, const std::string& key);

bool controls_its_error(const std::string& integrator);
bool solves_systems(const std::string& integrator);

// Linear solvers to test: all for SUNDIALS methods, otherwise a symmetric and a general one.
std::vector<std::string> tried_solvers(const std::string& integrator);

}  // namespace orthodyn
