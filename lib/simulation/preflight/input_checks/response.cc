// What the loads do to the body, by its linear static response: far too much, or nothing that could be seen.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "lib/core/errors.h"
#include "lib/scene/region.h"
#include "lib/simulation/preflight/input_checks/subject.h"

namespace orthodyn {

namespace {

constexpr double kImpossible = 1e3, kTooFar = 10, kUnseen = 1e-11;  // displacement, of the body's length
constexpr double kHardlySeen = 1e-4;                                // likewise, by a traction alone
constexpr double kMostPascals = 100;                                // of a force in N given as a traction
constexpr double kFewestSteps = 5;                                  // in a period
constexpr double kSoftModulus = 1e6;                                // Pa; rubber has as much
constexpr double kLongBody = 20, kShortBody = 1e-6;                 // m

// A place of the scene, and what is most likely wrong there.
struct LikelySlip {
  std::string place, words;
};

double stiffest_constant(const Scene& scene, const FemModel& model) {
  double stiffest = 0;
  for (const auto& term : model.parts().elastic)
    stiffest = std::max(stiffest, voigt(material_in(scene, term->region()).stiffness()).diagonal().maxCoeff());
  return stiffest;
}

LikelySlip slip_of_size(const Config& config, double extent, double stiffest) {
  const auto gravity = input_checks::value_at(config, {"gravity"});
  const auto place = [&](const char* key) { return input_checks::value_at(config, {key}).value_or(config).where(); };
  if (gravity && Value<Vec3>::read(*gravity, {.unit = "m/s^2"}).norm() > 100)
    return {gravity->where(), "is the gravity in m/s^2?"};
  if (extent < kShortBody)
    return {place("mesh"), fmt::format("the body is {:.4g} m long: is it scaled twice?", extent)};
  if (extent > kLongBody)
    return {place("mesh"), fmt::format("the body is {:.4g} m long: are its lengths in mm, and the moduli in MPa? Both "
                                       "are m and Pa here",
                                       extent)};
  if (stiffest < kSoftModulus)
    return {place("materials"), fmt::format("the stiffness is at most {:.3g} Pa: is the unit of the moduli missing, "
                                            "such as GPa or MPa?",
                                            stiffest)};
  return {place(config.has("loads")   ? "loads"
                : config.has("terms") ? "terms"
                                      : "gravity"),
          "are forces in N, tractions in Pa, moduli in Pa, lengths in m?"};
}

std::string moved_by(double share) {
  return share < 1 ? fmt::format("{:.2g} of its length", share)
                   : input_checks::shown_factor(share) + " times its length";
}

// rad/s, of the vibration that the loads start, by Rayleigh's quotient.
double frequency_of(const FemModel& model, const StaticResponse& statics) {
  Vector momentum(statics.displacement.size());
  model.multiply_mass(statics.displacement, momentum);
  return std::sqrt(statics.work / statics.displacement.dot(momentum));
}

void check_step(const Config& config, const FemModel& model, const StaticResponse& statics, Warnings& out) {
  const auto given = input_checks::value_at(config, {"integrator", "step"});
  if (!given || given->text() == "auto") return;
  const double step = read_number(*given, {.unit = "s"});
  const double period = 2 * std::numbers::pi / frequency_of(model, statics);
  if (step > period / kFewestSteps)
    out.push_back(
        fmt::format("{}: steps of {:.4g} s cannot follow the vibration that the loads start, whose period is "
                    "about {:.2g} s: is the step in ms? {:.1g} s is coarse already",
                    given->where(), step, period, period / 20));
}

// The number of N is often given as the traction, of some Pa.
void check_traction(const Config& config, const Scene& scene, double share, Warnings& out) {
  if (share >= kHardlySeen || scene.gravity || !scene.terms.empty() || !scene.motions.empty() || scene.initial) return;
  if (scene.loads.size() != 1) return;
  const Config load = config.at("loads").at(0);
  const auto traction = input_checks::value_at(load, {"traction"});
  if (!traction || !traction->is_sequence()) return;
  for (std::size_t i = 0; i < traction->size(); ++i)
    if (!traction->at(i).reads_as_number() || std::abs(traction->at(i).number()) > kMostPascals) return;
  out.push_back(
      fmt::format("{}: the traction, in Pa, moves the body by {} only: is a force in N meant? That is the "
                  "key 'force'",
                  load.where(), moved_by(share)));
}

}  // namespace

Warnings check_response(const Config& config, const Scene& scene, const BuiltScene& built,
                        const StaticResponse& statics) {
  if (statics.load.isZero(0)) return {};
  const double extent = bounding_box(built.model->parts().mesh).size().maxCoeff();
  const LikelySlip slip = slip_of_size(config, extent, stiffest_constant(scene, *built.model));
  if (!statics.load.allFinite()) throw ConfigError(slip.place, "the loads are too large to be numbers; " + slip.words);
  if (!statics.exists()) return {};
  const double share = statics.displacement.lpNorm<Eigen::Infinity>() / extent;
  const std::string finding = fmt::format("the loads move the body by {} (by linear statics)", moved_by(share));
  if (share > kImpossible) throw ConfigError(slip.place, fmt::format("{}; {}", finding, slip.words));
  if (share > kTooFar) return {fmt::format("{}: {}; {}", slip.place, finding, slip.words)};
  if (share < kUnseen)
    return {
        fmt::format("{}: {}, too little to be seen in the digits of a result: are forces in N, tractions and "
                    "moduli in Pa?",
                    input_checks::value_at(config, {"loads"}).value_or(config).where(), finding)};
  Warnings out;
  if (!scene.is_static()) check_step(config, *built.model, statics, out);
  check_traction(config, scene, share, out);
  return out;
}

}  // namespace orthodyn
