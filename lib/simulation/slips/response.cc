// What the loads do to the body, by its linear static response: far too much, or nothing that could be seen.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "lib/core/errors.h"
#include "lib/scene/region.h"
#include "lib/simulation/slips/subject.h"

namespace orthodyn {

namespace {

constexpr double kImpossible = 1e3, kTooFar = 20, kUnseen = 1e-11;  // displacement, of the body's length
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
  const auto gravity = slip::value_at(config, {"gravity"});
  const auto place = [&](const char* key) { return slip::value_at(config, {key}).value_or(config).where(); };
  if (gravity && Value<Vec3>::read(*gravity, {.unit = "m/s^2"}).norm() > 100)
    return {gravity->where(), "is the gravity in m/s^2?"};
  if (extent < kShortBody)
    return {place("mesh"), fmt::format("the body is {:.4g} m long: is it scaled twice?", extent)};
  if (extent > kLongBody)
    return {place("mesh"), fmt::format("the body is {:.4g} m long: are its lengths in mm, and the moduli in MPa? Both "
                                       "are m and Pa here", extent)};
  if (stiffest < kSoftModulus)
    return {place("materials"), fmt::format("the stiffness is at most {:.3g} Pa: is the unit of the moduli missing, "
                                            "such as GPa or MPa?", stiffest)};
  return {place(config.has("loads") ? "loads" : config.has("terms") ? "terms" : "gravity"),
          "are forces in N, tractions in Pa, moduli in Pa, lengths in m?"};
}

}  // namespace

Warnings response_slips(const Config& config, const Scene& scene, const BuiltScene& built,
                        const StaticResponse& statics) {
  if (!statics.exists() || statics.load.isZero(0)) return {};
  const double extent = bounding_box(built.model->parts().mesh).size().maxCoeff();
  const double share = statics.displacement.lpNorm<Eigen::Infinity>() / extent;
  const LikelySlip slip = slip_of_size(config, extent, stiffest_constant(scene, *built.model));
  const std::string finding = fmt::format("by linear statics the loads move the body by {:.2g} of its length", share);
  if (share > kImpossible) throw ConfigError(slip.place, fmt::format("{}; {}", finding, slip.words));
  if (share > kTooFar) return {fmt::format("{}: {}; {}", slip.place, finding, slip.words)};
  if (share < kUnseen)
    return {fmt::format("{}: {}, too little to be seen in the digits of a result: are forces in N, tractions and "
                        "moduli in Pa?", slip::value_at(config, {"loads"}).value_or(config).where(), finding)};
  return {};
}

}  // namespace orthodyn
