#include "integrators/automatic/modal_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "integrators/native/modal.h"
#include "lib/core/errors.h"

namespace orthodyn {
namespace {

constexpr int kFewest = 20, kMost = 640;   // modes that are looked for
constexpr double kMostShare = 0.2;         // of the unknowns
constexpr int kSmall = 100;                // unknowns of which all modes are taken if need be
constexpr double kMostNumbers = 5e7;       // in the vectors of Lanczos' method
constexpr double kVectors = 2.5;           // of Lanczos' method, for each mode
constexpr double kOrthogonal = 0.3;        // forces per entry of the matrix, of the product of two vectors: measured
constexpr double kSearches = 3;            // in units of the last one: those before it, and that of the integrator
constexpr double kWorthIt = 0.5;           // of the other method's cost
constexpr double kVelocity = 10;           // times rtol: of the velocity

// In forces: factors, solutions, and vectors that are made orthogonal to each other.
double cost_of_modes(const Model& model, const CostEstimate& cost, int modes) {
  const double vectors = kVectors * modes;
  const double orthogonal =
      kOrthogonal * vectors * vectors * model.num_dofs() / static_cast<double>(model.pattern().non_zeros());
  return kSearches * (cost.factor_cost + vectors * (1 + cost.solve_cost) + orthogonal);
}

int most_modes(const Model& model) {
  const int n = model.num_dofs();
  if (n <= kSmall) return n;
  return std::min({kMost, static_cast<int>(kMostShare * n), static_cast<int>(kMostNumbers / kVectors / n)});
}

}  // namespace

std::optional<MethodChoice> plan_modal(const Model& model, const Task& task, const CostEstimate& cost, double rtol,
                                       const MethodChoice& other) {
  if (!model.traits().linear || model.ranks() || !model.pattern().symmetric || !cost.has_factor) return std::nullopt;
  const int most = most_modes(model);
  const double worth = kWorthIt * other.cost;
  try {
    for (int modes = std::min(kFewest, most); modes > 0; modes = std::min(2 * modes, most)) {
      const double price = cost_of_modes(model, cost, modes);
      if (price > worth) return std::nullopt;
      const auto left_out = try_modal(model, task, modes, rtol, static_cast<long>(worth - price));
      if (!left_out) return std::nullopt;
      if (left_out->displacement <= rtol && left_out->velocity <= kVelocity * rtol)
        return MethodChoice{"modal", fmt::format("the model is linear, and {} modes leave out {:.1g} of the motion",
                                                 modes, left_out->displacement),
                            std::nullopt, modes, price};
      if (modes == most) return std::nullopt;
    }
  } catch (const ConfigError&) {  // its modes cannot serve; other methods do
  } catch (const RunError&) {
  } catch (const RecoverableError&) {
  }
  return std::nullopt;
}

}  // namespace orthodyn
