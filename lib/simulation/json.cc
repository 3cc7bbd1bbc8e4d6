#include "lib/simulation/json.h"

namespace orthodyn {

namespace {

Json to_json(const Cost& cost) { return {{"count", cost.count}, {"seconds", cost.seconds}}; }

}  // namespace

Json to_json(const Statistics& s) {
  return {{"steps", s.steps},
          {"rejected_steps", s.rejected_steps},
          {"error_test_failures", s.error_test_failures},
          {"convergence_failures", s.convergence_failures},
          {"newton_iterations", s.newton_iterations},
          {"gauss_newton_fallbacks", s.gauss_newton_fallbacks},
          {"force", to_json(s.force)},
          {"tangent", to_json(s.tangent)},
          {"factorization", to_json(s.factorization)},
          {"solve", to_json(s.solve)}};
}

}  // namespace orthodyn
