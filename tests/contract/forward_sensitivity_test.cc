// Forward sensitivities of the integrators that compute them, against closed forms.
#include <cmath>

#include "lib/ode/sensitivity_equations.h"
#include "tests/contract/integrators.h"

namespace orthodyn::forward_sensitivity_test {
namespace {

constexpr double kStiffness = 4, kMass = 1.5, kStart = 1;

// m q'' = -k q, q(0) = a, q'(0) = 0: q = a cos(w t) with w = sqrt(k/m). Parameters: k, m, a.
class Oscillator : public SensitivityEquations {
 public:
  Oscillator() {
    for (int i = 0; i < count(); ++i) initial_.push_back(exact(i, 0));
  }
  static LinearModel model(double end) {
    return LinearModel({.mass = scalar(kMass), .stiffness = scalar(kStiffness), .start = Vector::Ones(1), .end = end});
  }

  int count() const override { return 3; }
  double scale(int) const override { return 1; }
  const State& initial(int i) const override { return initial_[static_cast<std::size_t>(i)]; }
  void force(int i, double, const ConstVectorRef& q, const ConstVectorRef&, const ConstVectorRef& a,
             const ConstVectorRef& s, const ConstVectorRef&, VectorRef out) override {
    const Vector partial[] = {-q, -a, Vector::Zero(1)};
    out = partial[i] - kStiffness * s;
  }

  static State exact(int i, double t) {
    const double w = std::sqrt(kStiffness / kMass), c = std::cos(w * t), s = std::sin(w * t);
    const double by_w[] = {-kStart * t * s, -kStart * (s + w * t * c)};  // d(q, q')/dw
    const double slope = i == 0 ? w / (2 * kStiffness) : -w / (2 * kMass);
    if (i == 2) return {t, Vector::Constant(1, c), Vector::Constant(1, -w * s)};
    return {t, Vector::Constant(1, slope * by_w[0]), Vector::Constant(1, slope * by_w[1])};
  }

 private:
  std::vector<State> initial_;
};

// Largest error over the steps and inside of them.
double largest_error(const std::string& yaml, int restarts) {
  constexpr double kEnd = 6;
  const LinearModel model = Oscillator::model(kEnd);
  Oscillator equations;
  const auto choice = Registry<IntegratorChoice>::read(Config::from_text(yaml, "integrator"));
  EXPECT_TRUE(choice->computes_sensitivities()) << yaml;
  Task task{[] { return Scales{1, 1}; }, model.initial(), kEnd};
  task.sensitivities = &equations;
  const auto integrator = choice->make(model, task);
  double largest = 0;
  State state = model.initial(), found;
  integrator->start(state);
  for (int part = 1; part <= restarts + 1; ++part) {
    const double stop = part * kEnd / (restarts + 1);
    while (state.t < stop) {
      const StepInfo info = integrator->step(stop);
      integrator->interpolate(info.t, state);
      for (const double t : {info.t - info.h / 2, info.t})
        for (int i = 0; i < equations.count(); ++i) {
          integrator->interpolate_sensitivity(i, t, found);
          const State exact = Oscillator::exact(i, t);
          largest = std::max({largest, std::abs(found.q[0] - exact.q[0]), std::abs(found.v[0] - exact.v[0])});
        }
    }
    if (part <= restarts) integrator->start(state);
  }
  return largest;
}

// Largest error of `method` at a tolerance. `keys`: further keys, as ", key: value".
double error_of(const std::string& method, const char* rtol, int restarts = 0, const std::string& keys = "") {
  return largest_error("{type: " + method + ", rtol: " + rtol + keys + "}", restarts);
}

class ForwardSensitivity : public testing::TestWithParam<const char*> {};

TEST_P(ForwardSensitivity, OfAnOscillatorFollowsTheTolerance) {
  for (const char* corrector : {"", ", sensitivity_corrector: simultaneous"}) {
    const double coarse = error_of(GetParam(), "1e-4", 0, corrector), fine = error_of(GetParam(), "1e-7", 0, corrector);
    EXPECT_LT(coarse, 0.2) << corrector;
    EXPECT_LT(fine, 5e-4) << corrector;
    EXPECT_LT(fine, coarse / 50) << corrector;
    EXPECT_LT(error_of(GetParam(), "1e-7", 3, corrector), 5e-4) << corrector;  // restarts, as at kinks of loads
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, ForwardSensitivity, testing::Values("cvode_bdf", "cvode_adams", "ida_bdf"));

}  // namespace
}  // namespace orthodyn::forward_sensitivity_test
