#include "tests/contract/integrators.h"

#include <fmt/format.h>

namespace orthodyn {

std::vector<Pair> all_pairs() {
  std::vector<Pair> pairs;
  for (const auto& [name, method] : tested_methods())
    if (!method.chooses)
      for (const auto& solver : tried_solvers(name)) pairs.push_back({name, solver});
  return pairs;
}

std::string reading_refusal(const std::string& yaml) {
  try {
    Registry<IntegratorChoice>::read(Config::from_text(yaml, "a.yaml"));
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

std::vector<Pair> pairs_with(const std::string& key) {
  std::vector<Pair> pairs;
  for (const auto& pair : all_pairs())
    if (has_key(pair.integrator, key)) pairs.push_back(pair);
  return pairs;
}

bool refuses_consistent_mass(const Pair& pair) { return pair.solver == "klu_full" && pair.integrator != "ida_bdf"; }

bool leaves_out_solutions(const Pair& pair) { return pair.solver == "petsc"; }

const Variant& variant(const std::string& integrator, int order) {
  const auto& all = tested(integrator).variants;
  for (const auto& one : all)
    if (one.order == order) return one;
  return all.front();
}

std::unique_ptr<Integrator> make_integrator(const Pair& pair, const SmallModel& model, const Options& o) {
  std::string yaml = "{type: " + pair.integrator + tested(pair.integrator).needs;
  if (controls_its_error(pair.integrator)) yaml += fmt::format(", rtol: {}", o.rtol);
  else if (o.more.find("step:") == std::string::npos) yaml += ", step: 0.01";
  // A method without a step limit on linear models would need only a few steps.
  if (tested(pair.integrator).exact_if_linear && o.more.find("step:") == std::string::npos &&
      o.more.find("h_max:") == std::string::npos)
    yaml += ", h_max: 0.05";
  if (pair.solver != "none") yaml += ", linear_solver: " + pair.solver;
  if (o.more.find("table:") == std::string::npos) yaml += variant(pair.integrator, o.order).options;
  const auto choice = Registry<IntegratorChoice>::read(Config::from_text(yaml + o.more + "}"));
  return choice->make(model, {[&] { return model.scales(); }, model.initial(), model.end(), model.end() / 50});
}

State integrate(const SmallModel& model, Integrator& integrator, const OnStep& on_step) {
  State state = model.initial();
  std::vector<double> stops = model.breakpoints(state.t, model.end());
  stops.push_back(model.end());
  for (const double stop : stops) {
    integrator.start(state);
    StepInfo info;
    do {
      info = integrator.step(stop);
      if (on_step) on_step(info, integrator);
    } while (info.t < stop);
    integrator.interpolate(stop, state);
  }
  return state;
}

double distance(const State& a, const State& b, const Scales& scales) {
  return std::max((a.q - b.q).lpNorm<Eigen::Infinity>() / scales.position,
                  (a.v - b.v).lpNorm<Eigen::Infinity>() / scales.velocity);
}

}  // namespace orthodyn
