// The linear static response to the loads: far too large, or too small to be seen.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "lib/core/errors.h"
#include "lib/ode/internal_variables.h"
#include "lib/simulation/error_estimate/mass_norm.h"
#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn {

namespace input_checks {

namespace {

constexpr double kImpossible = 1e3, kTooFar = 10, kUnseen = 1e-11;  // displacement over the body's length
constexpr double kHardlySeen = 1e-4;                                // likewise, by a traction alone
constexpr double kMaxPascals = 100;                                 // of a traction that is probably a force in N
constexpr double kFewestStepsInPeriod = 5;                          // time steps per period of the vibration
constexpr double kSoftModulus = 1e6;                                // Pa; about that of rubber
constexpr double kLongBody = 20, kShortBody = 1e-6;                 // m

// The most likely error in a scene, and its place.
struct LikelyError {
  std::string place, words;
};

double stiffest_constant(const FemModel& model) {
  double stiffest = 0;
  for (const auto& term : model.parts().elastic) stiffest = std::max(stiffest, term->stiffness().diagonal().maxCoeff());
  return stiffest;
}

LikelyError likely_error(const Config& config, double extent, double stiffest) {
  const auto gravity = find_value(config, {"gravity"});
  const auto place = [&](const char* key) { return find_value(config, {key}).value_or(config).where(); };
  if (gravity && Value<Vec3>::read(*gravity, {.unit = "m/s^2"}).norm() > 100)
    return {gravity->where(), "is the gravity in m/s^2?"};
  if (extent < kShortBody)
    return {place("mesh"), fmt::format("the body is {:.4g} m long: is it scaled twice?", extent)};
  if (extent > kLongBody)
    return {
        place("mesh"),
        fmt::format("the body is {:.4g} m long: are its lengths in mm, and the moduli in MPa? Both are m and Pa here",
                    extent)};
  if (stiffest < kSoftModulus)
    return {place("materials"),
            fmt::format("the stiffness is at most {:.3g} Pa: is the unit of the moduli missing, such as GPa or MPa?",
                        stiffest)};
  return {place(config.has("loads")   ? "loads"
                : config.has("terms") ? "terms"
                                      : "gravity"),
          "are forces in N, tractions in Pa, moduli in Pa, lengths in m?"};
}

std::string moved_by(double share) {
  return share < 1 ? fmt::format("{:.2g} of its length", share) : factor_text(share) + " times its length";
}

void check_fixed_step(const Config& config, const FemModel& model, const StaticResponse& statics, Warnings& out) {
  const auto value = find_value(config, {"integrator", "step"});
  if (!value || value->text() == "auto") return;
  const double step = read_number(*value, {.unit = "s"});
  const InternalVariables* internal = model.internal_variables();
  if (internal && internal->relaxation_times().maxCoeff() > step) return;  // slow creep needs no short steps
  // Frequency (rad/s) of the vibration that the loads start, by the Rayleigh quotient of the static response.
  const double omega = std::sqrt(statics.work / mass_product(model, statics.displacement));
  const double period = 2 * std::numbers::pi / omega;
  if (step > period / kFewestStepsInPeriod)
    warn(out, value->where(),
         "steps of {:.4g} s cannot follow the vibration that the loads start (period about {:.2g} s): is the step in "
         "ms? {:.1g} s is already coarse",
         step, period, period / 20);
}

// Warns of a traction (Pa) that is probably meant as a force in N.
void check_traction(const Config& config, const Scene& scene, double share, Warnings& out) {
  if (share >= kHardlySeen || scene.gravity || !scene.terms.empty() || !scene.motions.empty() || scene.initial) return;
  if (scene.loads.size() != 1) return;
  const Config load = config.at("loads").at(0);
  const auto traction = find_value(load, {"traction"});
  if (!traction || !traction->is_sequence()) return;
  for (std::size_t i = 0; i < traction->size(); ++i)
    if (!traction->at(i).reads_as_number() || std::abs(traction->at(i).number()) > kMaxPascals) return;
  warn(out, load.where(),
       "the traction, in Pa, moves the body by {} only: is a force in N intended? Use the key 'force'",
       moved_by(share));
}

}  // namespace

}  // namespace input_checks

Warnings check_response(const Config& config, const Scene& scene, const BuiltScene& built,
                        const StaticResponse& statics) {
  using namespace input_checks;
  if (statics.load.isZero(0)) return {};
  const double extent = bounding_box(built.model->parts().mesh).size().maxCoeff();
  const LikelyError error = likely_error(config, extent, stiffest_constant(*built.model));
  if (!statics.load.allFinite())
    throw ConfigError(error.place, "the loads exceed the range of numbers; " + error.words);
  if (!statics.exists()) return {};
  // Fibres stiffen when stretched, and the force-length factor limits the contraction of muscles; linear statics know
  // neither.
  const auto has_fibres = [](const auto& material) { return material.second->fibres().has_value(); };
  if (std::any_of(scene.materials.begin(), scene.materials.end(), has_fibres)) return {};
  const double share = statics.displacement.lpNorm<Eigen::Infinity>() / extent;
  const std::string finding = fmt::format("the loads move the body by {} (by linear statics)", moved_by(share));
  // Bodies that soft springs hold come to rest on each other, or on the ground.
  const bool may_touch = !built.model->parts().contacts.empty();
  if (share > kTooFar && may_touch)
    return {fmt::format("{}: {} unless contact stops it; {}", error.place, finding, error.words)};
  if (share > kImpossible) throw ConfigError(error.place, fmt::format("{}; {}", finding, error.words));
  if (share > kTooFar) return {fmt::format("{}: {}; {}", error.place, finding, error.words)};
  if (share < kUnseen)
    return {fmt::format("{}: {}, too little to be visible in the results: are forces in N, tractions and moduli in Pa?",
                        find_value(config, {"loads"}).value_or(config).where(), finding)};
  Warnings out;
  if (!scene.is_static()) check_fixed_step(config, *built.model, statics, out);
  check_traction(config, scene, share, out);
  return out;
}

}  // namespace orthodyn
