#include "integrators/automatic/modal_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "integrators/native/modal_trial.h"
#include "integrators/random_vector.h"
#include "lib/core/errors.h"

namespace orthodyn {
namespace {

constexpr int kMinModes = 20, kMaxModes = 640;
constexpr double kMaxShare = 0.2;      // largest number of modes per unknown
constexpr int kSmallModel = 100;       // up to this number of unknowns, all modes may be used
constexpr double kMaxNumbers = 5e7;    // largest number of entries of all Lanczos vectors
constexpr double kVectors = 2.5;       // Lanczos vectors per mode
constexpr double kInnerProduct = 0.3;  // measured: an inner product costs this times unknowns / non-zeros (forces)
constexpr double kForces = 8;          // forces and solves per step
constexpr double kProducts = 2;        // products of all modes with a vector, per force
constexpr double kCostShare = 0.5;     // accepted cost relative to the other method
constexpr double kVelocity = 10;       // accepted share of the velocity left out, in units of rtol
constexpr double kSameForce = 1e-8;    // accepted error of the linear force, relative to its parts
constexpr double kMaxSteps = 1e9;

// Costs of `modal` in force evaluations.
class ModalCost {
 public:
  ModalCost(const Model& model, const CostEstimate& cost)
      : cost_(cost),
        product_cost_(kInnerProduct * model.num_dofs() / static_cast<double>(model.pattern().non_zeros())) {}

  double search(int modes) const {
    const double vectors = kVectors * modes;
    return cost_.factor_cost + vectors * (1 + cost_.solve_cost) + product_cost_ * vectors * vectors;
  }
  double step(int modes) const { return kForces * (1 + cost_.solve_cost + kProducts * product_cost_ * modes); }

 private:
  const CostEstimate& cost_;
  double product_cost_;
};

int max_modes(const Model& model) {
  const int n = model.num_dofs();
  if (n <= kSmallModel) return n;
  return std::min({kMaxModes, static_cast<int>(kMaxShare * n), static_cast<int>(kMaxNumbers / kVectors / n)});
}

// Checks f(t, q, v) = f(t, 0, 0) - K q - D v at a random state. The check is needed because a user's model may be
// declared linear although its tangents are approximate.
bool force_is_linear(const Model& model, const Task& task) {
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
                                   const ErrorControl& control, double allowed_cost) {
  const ModalCost modal_cost(model, cost);
  const int most = max_modes(model);
  double spent = 0;
  for (int modes = std::min(kMinModes, most); modes > 0; modes = std::min(2 * modes, most)) {
    // The run repeats the search for modes and the steps of the trial: hence the factor 2.
    const double left = allowed_cost - spent - 2 * modal_cost.search(modes);
    if (!(left > 0)) return std::nullopt;
    const auto most_steps = static_cast<long>(std::min(left / 2 / modal_cost.step(modes), kMaxSteps));
    const auto trial = try_modal(model, task, control, modes, most_steps);
    if (!trial) return std::nullopt;
    spent += modal_cost.search(modes) + static_cast<double>(trial->steps) * modal_cost.step(modes);
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
    if (force_is_linear(model, task)) return search(model, task, cost, control, kCostShare * other.cost);
  } catch (const ConfigError&) {  // modes cannot be used; `other` can
  } catch (const RunError&) {
  } catch (const RecoverableError&) {
  }
  return std::nullopt;
}

}  // namespace orthodyn
