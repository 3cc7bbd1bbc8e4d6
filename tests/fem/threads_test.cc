// Results are bitwise identical for any number of threads.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "lib/core/parallel.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::threads_test {
namespace {

struct Case {
  const char* name;
  int order;
  const char* elasticity;
};

class Threads : public testing::TestWithParam<Case> {
 protected:
  Threads()
      : scene_(fmt::format("mesh: {{type: box, size: [3, 1, 1], cells: [17, 6, 5], order: {}}}\n"
                           "materials: {{m: {{type: isotropic, density: 1, young: 1, nu: 0.3}}}}\n"
                           "elasticity: {}\nclamps: [{{surface: x0}}]\ndamping: {{stiffness: 0.1}}\ntime: {{end: 1}}\n",
                           GetParam().order, GetParam().elasticity)) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(-0.08, 0.08);  // of the cells, some of which are inverted
    q_ = v_ = scene_.zero();
    for (double& x : q_) x = share(random);
    for (double& x : v_) x = share(random);
  }

  // All results of element loops.
  std::vector<double> computed(int count) const {
    const LoopThreads threads(count);
    const Model& model = scene_.model();
    std::vector<double> all;
    const auto keep = [&](const auto& values) { all.insert(all.end(), values.begin(), values.end()); };
    Vector f(q_.size());
    model.force(0, q_, v_, f);
    keep(f);
    for (const TangentKind kind : {TangentKind::exact, TangentKind::gauss_newton}) {
      Linearization at;
      model.linearize(0, q_, v_, kind, at);
      keep(at.stiffness);
      keep(at.damping);
      std::vector<double> sum(model.pattern().row.size());
      model.combine({1, 2, 3}, at, sum.data());
      keep(sum);
    }
    Linearization predicted;
    model.linearize_predicted(0, 0.5 * q_, 0, q_, predicted);
    keep(predicted.stiffness);
    if (const auto* gradient = model.discrete_gradient()) {
      gradient->mean_force(0, 0.05 * q_, 1, 0.1 * q_, v_, f);
      keep(f);
    }
    const auto view = model.view({0, q_, v_});
    for (const char* name : {"energy.elastic", "power.dissipated", "det_f.smallest"}) keep(view->evaluate(name));
    return all;
  }

  BuiltTestScene scene_;
  Vector q_, v_;
};

TEST_P(Threads, ChangeNoBit) {
  const auto one = computed(1);
  ASSERT_GT(one.size(), 10'000u);
  for (const int count : {2, 3, 8}) EXPECT_EQ(computed(count), one) << count;
}

INSTANTIATE_TEST_SUITE_P(Elements, Threads,
                         testing::Values(Case{"linear", 1, "{}"}, Case{"quadratic", 2, "{}"},
                                         Case{"small_strain", 1, "{kinematics: linear}"}),
                         [](const auto& it) { return it.param.name; });

}  // namespace
}  // namespace orthodyn::threads_test
