// Every integrator of the registry with every linear solver that it takes.
#pragma once

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "tests/contract/methods.h"
#include "tests/contract/models.h"
#include "tests/contract/order.h"

namespace orthodyn {

struct Pair {
  std::string integrator, solver;
};
inline void PrintTo(const Pair& p, std::ostream* os) { *os << p.integrator << "/" << p.solver; }
inline std::string pair_name(const testing::TestParamInfo<Pair>& tested) {
  return tested.param.integrator + "_" + tested.param.solver;
}

inline std::vector<Pair> all_pairs() {
  std::vector<Pair> pairs;
  for (const auto& [name, method] : tested_methods())
    if (!method.chooses) for (const auto& solver : tried_solvers(name)) pairs.push_back({name, solver});
  return pairs;
}

// What reading an integrator's section says of it; "" if it is taken.
inline std::string refusal(const std::string& yaml) {
  try {
    Registry<IntegratorChoice>::read(Config::from_text(yaml, "a.yaml"));
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

// Those whose integrator has the key.
inline std::vector<Pair> pairs_with(const std::string& key) {
  std::vector<Pair> pairs;
  for (const auto& pair : all_pairs())
    if (has_key(pair.integrator, key)) pairs.push_back(pair);
  return pairs;
}

// klu_full of a method for y' = (v, M^-1 f) would need the inverse of a consistent mass, which is dense.
inline bool refuses_consistent_mass(const Pair& pair) {
  return pair.solver == "klu_full" && pair.integrator != "ida_bdf";
}

struct Options {
  double rtol = 1e-5;
  int order = 2;          // the first variant where the method has none of this order
  std::string more = "";  // ", key: value"
};

inline const Variant& variant(const std::string& integrator, int order) {
  const auto& all = tested(integrator).variants;
  for (const auto& one : all)
    if (one.order == order) return one;
  return all.front();
}

// Without error control a step of 0.01 is taken, unless `more` says another.
inline std::unique_ptr<Integrator> make_integrator(const Pair& pair, const SmallModel& model, const Options& o = {}) {
  std::string yaml = "{type: " + pair.integrator + tested(pair.integrator).needs;
  if (controls_its_error(pair.integrator)) yaml += fmt::format(", rtol: {}", o.rtol);
  else if (o.more.find("step:") == std::string::npos) yaml += ", step: 0.01";
  // One whose step nothing limits on a linear model would be done in a few.
  if (tested(pair.integrator).exact_if_linear && o.more.find("step:") == std::string::npos &&
      o.more.find("h_max:") == std::string::npos)
    yaml += ", h_max: 0.05";
  if (pair.solver != "none") yaml += ", linear_solver: " + pair.solver;
  if (o.more.find("table:") == std::string::npos) yaml += variant(pair.integrator, o.order).options;
  const auto choice = Registry<IntegratorChoice>::read(Config::from_text(yaml + o.more + "}"));
  return choice->make(model, {[&] { return model.scales(); }, model.initial(), model.end(), model.end() / 50});
}

using OnStep = std::function<void(const StepInfo&, const Integrator&)>;

// From start to end with a restart at each breakpoint, as run() does.
inline State integrate(const SmallModel& model, Integrator& integrator, const OnStep& on_step = {}) {
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

inline double distance(const State& a, const State& b, const Scales& scales) {
  return std::max((a.q - b.q).lpNorm<Eigen::Infinity>() / scales.position,
                  (a.v - b.v).lpNorm<Eigen::Infinity>() / scales.velocity);
}

// The largest error over time: at the ends of steps, or between them at `fraction` of each.
template <class ExactModel>
double largest_error(const ExactModel& model, const Pair& pair, const Options& options, double fraction = 1) {
  double largest = 0;
  const auto integrator = make_integrator(pair, model, options);
  integrate(model, *integrator, [&](const StepInfo& info, const Integrator& i) {
    State state;
    i.interpolate(info.t - (1 - fraction) * info.h, state);
    largest = std::max(largest, distance(state, model.exact(state.t), model.scales()));
  });
  return largest;
}

}  // namespace orthodyn
