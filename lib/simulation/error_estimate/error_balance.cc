#include "lib/simulation/error_estimate/error_balance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace orthodyn {

namespace {

constexpr double kAccurateMesh = 5e-3;  // mesh error up to which no advice is given
constexpr double kDominates = 3;        // ratio above which one error dominates
constexpr double kLoosestRtol = 1e-2;
constexpr double kMargin = 30;  // least ratio of mesh error to integration error for which a larger rtol is proposed

std::optional<double> time_error(const MotionResult& motion) {
  if (motion.error && motion.error->completed && std::isfinite(motion.error->displacement.l2))
    return motion.error->displacement.l2;
  if (motion.segment_error && std::isfinite(motion.segment_error->error)) return motion.segment_error->error;
  return std::nullopt;
}

std::string finer(const ModelSummary& model) {
  return model.order == 1 ? "mesh.order: 2, or finer cells, would reduce it" : "finer cells would reduce it";
}

// A larger rtol, by a power of ten, that suffices for this mesh error, assuming that `time`, the integration error, is
// proportional to rtol. Empty if there is none.
std::optional<double> sufficient_rtol(double mesh, double time, double rtol) {
  if (!(kMargin * time < mesh)) return std::nullopt;
  const double decades = time > 0 ? std::floor(std::log10(mesh / (kMargin / 3 * time))) : 1;
  const double loose = std::min(rtol * std::pow(10, decades), kLoosestRtol);
  return loose > 2 * rtol ? std::optional(loose) : std::nullopt;
}

std::string advice(const RunResult& result, double mesh, const std::optional<double>& time) {
  if (!time) return mesh > kAccurateMesh ? finer(result.model) : "";
  if (*time > kDominates * mesh) return "the integration dominates: a smaller integrator.rtol or step would reduce it";
  if (mesh <= kDominates * *time || mesh <= kAccurateMesh) return "";
  std::string out = "the mesh dominates: " + finer(result.model);
  if (const auto& rtol = result.motion->rtol)
    if (const auto enough = sufficient_rtol(mesh, *time, *rtol))
      out += fmt::format("; for this mesh, rtol {:.0e} would suffice", *enough);
  return out;
}

}  // namespace

std::optional<ErrorBalance> error_balance(const RunResult& result) {
  if (!result.motion && !result.equilibrium) return std::nullopt;
  const auto& mesh = result.motion ? result.motion->mesh_error : result.equilibrium->mesh_error;
  if (!mesh) return std::nullopt;
  const std::optional<double> time = result.motion ? time_error(*result.motion) : std::nullopt;
  const std::string by = mesh->by_finer_elements ? fmt::format("finer elements, {:.2g} s of CPU", mesh->cpu_seconds)
                                                 : std::string("recovered stresses");
  return ErrorBalance{
      mesh->relative, by, time, mesh->probed, mesh->probed_unknown, advice(result, mesh->relative, time)};
}

}  // namespace orthodyn
