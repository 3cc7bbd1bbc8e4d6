// Every registered integrator with every linear solver that it accepts.
#pragma once

#include <gtest/gtest.h>

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

std::vector<Pair> all_pairs();

// Error message of reading an integrator's section; "" if it is accepted.
std::string reading_refusal(const std::string& yaml);

// The variants whose integrator has the key.
std::vector<Pair> pairs_with(const std::string& key);

// With klu_full, a method for y' = (v, M^-1 f) would need the dense inverse of a consistent mass.
bool refuses_consistent_mass(const Pair& pair);

// SUNDIALS skips corrections below the tolerance of an iterative solver.
bool leaves_out_solutions(const Pair& pair);

struct Options {
  double rtol = 1e-5;
  int order = 2;          // the first variant if the method has none of this order
  std::string more = "";  // ", key: value"
};

const Variant& variant(const std::string& integrator, int order);

// Methods without error control take a step of 0.01 unless `more` sets another.
std::unique_ptr<Integrator> make_integrator(const Pair& pair, const SmallModel& model, const Options& options = {});

using OnStep = std::function<void(const StepInfo&, const Integrator&)>;

// Integrates from start to end with a restart at each breakpoint, as run() does.
State integrate(const SmallModel& model, Integrator& integrator, const OnStep& on_step = {});

double distance(const State& a, const State& b, const Scales& scales);

// Largest error over time: at the ends of steps, or at `fraction` of each step.
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
