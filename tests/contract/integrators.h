// Every integrator of the registry with every linear solver that it takes.
#pragma once

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "lib/linear/solver.h"
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

inline bool has_key(const std::string& integrator, const std::string& key) {
  for (const auto& k : Registry<IntegratorChoice>::entries().at(integrator).keys)
    if (k.name == key) return true;
  return false;
}

inline std::vector<Pair> all_pairs() {
  std::vector<Pair> pairs;
  for (const auto& name : Registry<IntegratorChoice>::names()) {
    if (!has_key(name, "linear_solver")) pairs.push_back({name, "none"});
    else
      for (const auto& [solver, kind] : solver_registry()) pairs.push_back({name, solver});
  }
  return pairs;
}

// The table of a Runge-Kutta method of that order.
inline std::string table_of(int order) { return order == 2 ? "TRBDF2_3_3_2" : "ESDIRK547L2SA_7_4_5"; }

// klu_full of a method for y' = (v, M^-1 f) would need the inverse of a consistent mass, which is dense.
inline bool refuses_consistent_mass(const Pair& pair) {
  return pair.solver == "klu_full" && pair.integrator != "ida_bdf";
}

struct Options {
  double rtol = 1e-5;
  int max_order = 2;
  std::string more = "";  // ", key: value"
};

inline std::unique_ptr<Integrator> make_integrator(const Pair& pair, const SmallModel& model, const Options& o = {}) {
  std::string yaml = fmt::format("{{type: {}, rtol: {}", pair.integrator, o.rtol);
  if (pair.solver != "none") yaml += ", linear_solver: " + pair.solver;
  if (has_key(pair.integrator, "max_order")) yaml += fmt::format(", max_order: {}", o.max_order);
  if (has_key(pair.integrator, "table") && o.more.find("table:") == std::string::npos)
    yaml += ", table: " + table_of(o.max_order);
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
