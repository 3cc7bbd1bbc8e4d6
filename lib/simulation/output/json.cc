#include "lib/simulation/output/json.h"

namespace orthodyn {

namespace {

Json to_json(const Cost& cost) { return {{"count", cost.count}, {"seconds", cost.seconds}}; }

Cost cost_from(const Json& json) { return {json.at("count"), json.at("seconds")}; }

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
          {"solve", to_json(s.solve)},
          {"modes", to_json(s.modes)},
          {"observation", to_json(s.observation)}};
}

Statistics statistics_from(const Json& json) {
  Statistics s;
  s.steps = json.at("steps");
  s.rejected_steps = json.at("rejected_steps");
  s.error_test_failures = json.at("error_test_failures");
  s.convergence_failures = json.at("convergence_failures");
  s.newton_iterations = json.at("newton_iterations");
  s.gauss_newton_fallbacks = json.at("gauss_newton_fallbacks");
  s.force = cost_from(json.at("force"));
  s.tangent = cost_from(json.at("tangent"));
  s.factorization = cost_from(json.at("factorization"));
  s.solve = cost_from(json.at("solve"));
  s.modes = cost_from(json.at("modes"));
  if (json.contains("observation")) s.observation = cost_from(json.at("observation"));  // older results have none
  return s;
}

}  // namespace orthodyn
