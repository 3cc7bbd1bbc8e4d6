#include "integrators/automatic/modal_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "integrators/native/modal_trial.h"
#include "integrators/random_vector.h"
#include "lib/core/errors.h"

namespace orthodyn {
namespace {

constexpr int kFewest = 20, kMost = 640;  // modes that are looked for
constexpr double kMostShare = 0.2;        // of the unknowns
constexpr int kSmall = 100;               // unknowns of which all modes are taken if need be
constexpr double kMostNumbers = 5e7;      // in the vectors of Lanczos' method
constexpr double kVectors = 2.5;          // of Lanczos' method, for each mode
constexpr double kOrthogonal = 0.3;  // cost of an inner product, in forces, times non-zeros over unknowns: measured
constexpr double kForces = 8;        // and solutions in a step
constexpr double kProducts = 2;      // of all modes with a vector, for each force
constexpr double kWorthIt = 0.5;     // of the other method's cost
constexpr double kVelocity = 10;     // times rtol: of the velocity
constexpr double kSameForce = 1e-8;  // of the parts of a force
constexpr double kMostSteps = 1e9;

// Costs in evaluations of the force.
class ModalCost {
 public:
  ModalCost(const Model& model, const CostEstimate& cost)
      : cost_(cost), of_product_(kOrthogonal * model.num_dofs() / static_cast<double>(model.pattern().non_zeros())) {}

  double search(int modes) const {
    const double vectors = kVectors * modes;
    return cost_.factor_cost + vectors * (1 + cost_.solve_cost) + of_product_ * vectors * vectors;
  }
  double step(int modes) const { return kForces * (1 + cost_.solve_cost + kProducts * of_product_ * modes); }

 private:
  const CostEstimate& cost_;
  double of_product_;
};

int most_modes(const Model& model) {
  const int n = model.num_dofs();
  if (n <= kSmall) return n;
  return std::min({kMost, static_cast<int>(kMostShare * n), static_cast<int>(kMostNumbers / kVectors / n)});
}

// Checks f(t, q, v) = f(t, 0, 0) - K q - D v at a random state: a user's model may claim to be linear although its
// tangents are approximate.
bool is_linear_as_it_says(const Model& model, const Task& task) {
  const Scales scales = task.scales();
  const auto n = static_cast<Eigen::Index>(model.num_dofs());
  const Vector zero = Vector::Zero(n), direction = random_vector(model);
  const Vector q = task.initial.q + scales.position * direction;
  const Vector v = task.initial.v + scales.velocity * direction.reverse();
  Linearization at;
  model.linearize(task.initial.t, zero, zero, TangentKind::exact, at);
  std::vector<double> values(model.pattern().row.size());
  const auto product = [&](const Weights& weights, const Vector& x) {
    Vector y = Vector::Zero(n);
    model.combine(weights, at, values.data());
    model.pattern().multiply(values.data(), x, y);
    return y;
  };
  const Vector Kq = product({0, 0, 1}, q), Dv = product({0, 1, 0}, v);
  Vector f(n), f0(n);
  for (const double t : {task.initial.t, 0.5 * (task.initial.t + task.end)}) {
    model.force(t, q, v, f);
    model.force(t, zero, zero, f0);
    if (!((f - f0 + Kq + Dv).norm() <= kSameForce * (f.norm() + f0.norm() + Kq.norm() + Dv.norm()))) return false;
  }
  return true;
}

std::optional<MethodChoice> search(const Model& model, const Task& task, const CostEstimate& cost,
                                   const ErrorControl& control, double worth) {
  const ModalCost of(model, cost);
  const int most = most_modes(model);
  double spent = 0;
  for (int modes = std::min(kFewest, most); modes > 0; modes = std::min(2 * modes, most)) {
    // The run repeats this search and the steps of the trial.
    const double left = worth - spent - 2 * of.search(modes);
    if (!(left > 0)) return std::nullopt;
    const auto most_steps = static_cast<long>(std::min(left / 2 / of.step(modes), kMostSteps));
    const auto trial = try_modal(model, task, control, modes, most_steps);
    if (!trial) return std::nullopt;
    spent += of.search(modes) + static_cast<double>(trial->steps) * of.step(modes);
    if (trial->displacement_left_out <= control.rtol && trial->velocity_left_out <= kVelocity * control.rtol)
      return MethodChoice{"modal",
                          fmt::format("the model is linear, and {} modes leave out {:.1g} of the motion", modes,
                                      trial->displacement_left_out),
                          std::nullopt, modes, 2 * spent};
    if (modes == most) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

bool allows_modes(const Model& model) { return model.traits().linear && !model.ranks() && model.pattern().symmetric; }

std::optional<MethodChoice> plan_modal(const Model& model, const Task& task, const CostEstimate& cost,
                                       const ErrorControl& control, const MethodChoice& other) {
  if (!allows_modes(model) || !cost.has_factor) return std::nullopt;
  try {
    if (is_linear_as_it_says(model, task)) return search(model, task, cost, control, kWorthIt * other.cost);
  } catch (const ConfigError&) {  // modes cannot be used; `other` can
  } catch (const RunError&) {
  } catch (const RecoverableError&) {
  }
  return std::nullopt;
}

}  // namespace orthodyn
