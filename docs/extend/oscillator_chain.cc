// Example of a user's model without a mesh: a chain of masses and springs between two walls. CVODE integrates the chain
// over one period of its lowest mode; the result is compared with the exact solution.
#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <numbers>

#include "lib/simulation/run/run.h"

namespace {

using namespace orthodyn;

class Chain : public Model {
 public:
  Chain(int masses, double mass, double stiffness) : m_(mass), k_(stiffness) {
    pattern_.n = masses;
    for (int j = 0; j < masses; ++j) {  // lower triangle, column by column
      pattern_.column_start.push_back(pattern_.non_zeros());
      pattern_.row.push_back(j);
      if (j + 1 < masses) pattern_.row.push_back(j + 1);
    }
    pattern_.column_start.push_back(pattern_.non_zeros());
    traits_.linear = true;
  }

  int num_dofs() const override { return pattern_.n; }
  const Traits& traits() const override { return traits_; }
  const Pattern& pattern() const override { return pattern_; }

  void force(double, const ConstVectorRef& q, const ConstVectorRef&, VectorRef f) const override {
    const Eigen::Index n = q.size();
    for (Eigen::Index i = 0; i < n; ++i) f[i] = k_ * ((i > 0 ? q[i - 1] : 0) - 2 * q[i] + (i + 1 < n ? q[i + 1] : 0));
  }

  void assemble(double, const ConstVectorRef&, const ConstVectorRef&, TangentKind, Linearization& out) const override {
    out.stiffness.clear();
    for (int j = 0; j < pattern_.n; ++j) {
      out.stiffness.push_back(2 * k_);
      if (j + 1 < pattern_.n) out.stiffness.push_back(-k_);
    }
  }

  void combine(const Weights& w, const Linearization& at, double* values) const override {
    for (std::size_t i = 0; i < at.stiffness.size(); ++i) values[i] = w.stiffness * at.stiffness[i];
    for (int j = 0; j < pattern_.n; ++j) values[pattern_.column_start[static_cast<std::size_t>(j)]] += w.mass * m_;
  }

  void multiply_mass(const ConstVectorRef& x, VectorRef y) const override { y = m_ * x; }
  void solve_mass(VectorRef x) const override { x /= m_; }

 private:
  double m_, k_;
  Pattern pattern_;
  Traits traits_;
};

}  // namespace

int main() {
  constexpr int n = 20;
  constexpr double mass = 0.1, stiffness = 40;  // kg, N/m
  const Chain chain(n, mass, stiffness);

  // The lowest mode and its angular frequency.
  const double angle = std::numbers::pi / (n + 1);
  const double omega = 2 * std::sqrt(stiffness / mass) * std::sin(angle / 2);
  State start{0, Vector(n), Vector::Zero(n)};
  for (int i = 0; i < n; ++i) start.q[i] = std::sin((i + 1) * angle);

  const Config options = Config::from_text("{type: cvode_bdf, rtol: 1e-6, max_order: 2}");
  const double end = 2 * std::numbers::pi / omega;  // one period
  const Task task{[=] { return Scales{1, omega}; }, start, end, end};
  const auto integrator = Registry<IntegratorChoice>::read(options)->make(chain, task);
  const std::atomic<bool> never{false};
  const Outcome outcome = run(chain, *integrator, start, {.end = end, .output_times = {}}, {}, never);
  const double error = (outcome.last.q - start.q).norm() / start.q.norm();
  fmt::print("one period of {:.4f} s in {} steps: error {:.1e}\n", end, integrator->statistics().steps, error);
  return outcome.status == Outcome::Status::completed && error < 1e-3 ? 0 : 1;
}
