// Constants of materials that no solid has, or that do not go with each other.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/symmetric_eigen.h"
#include "lib/simulation/slips/subject.h"

namespace orthodyn::slip {

namespace {

constexpr double kFastest = 25e3;     // m/s; diamond has 18,000
constexpr double kSlowest = 0.3;      // m/s; a gel of 100 Pa has as much
constexpr double kDensest = 30e3;     // kg/m^3; osmium has 22,600
constexpr double kMostUnlike = 1e-7;  // of the eigenvalues of C
constexpr double kSoftest = 1e3;      // Pa
constexpr double kWeakest = 1e-6;     // strength over the softest modulus; the weakest woods and foams have 1e-3

std::string slip_of(const Material& material) {
  const double density = material.density(), wave = fastest_wave(material);
  const Vec6 lambda = symmetric_eigenvalues(voigt(material.stiffness()));
  const double stiffest = lambda.maxCoeff(), softest = lambda.minCoeff();
  if (density > kDensest)
    return fmt::format("the density {:.4g} kg/m^3 is beyond that of any metal: is its unit g/m^3, or is it in kg/m^3 "
                       "already and has a unit too many?", density);
  if (wave > kFastest)
    return fmt::format("waves would travel at {:.3g} m/s, faster than in any solid (diamond: 18000 m/s): the density "
                       "{:.4g} kg/m^3 is too small for moduli up to {:.3g} Pa. Is it in {}?",
                       wave, density, stiffest, density < 1e-3 ? "t/mm^3 (orthodyn computes in m, kg, s)" : "g/cm^3");
  if (softest < kMostUnlike * stiffest)
    return fmt::format("its moduli differ by a factor {:.1g} (eigenvalues of C {:.3g} to {:.3g} Pa): does one of them "
                       "lack its unit, such as GPa?", stiffest / softest, softest, stiffest);
  if (const auto strength = material.strength()) {
    const double weakest =
        std::min({strength->tension.minCoeff(), strength->compression.minCoeff(), strength->shear.minCoeff()});
    if (weakest > 0 && weakest < kWeakest * softest)
      return fmt::format("its strength of {:.3g} Pa is {:.1g} of its softest modulus, and is passed at once: is the "
                         "unit missing, such as MPa?", weakest, weakest / softest);
  }
  if (wave < kSlowest && stiffest < kSoftest)
    return fmt::format("its moduli of at most {:.3g} Pa at a density of {:.4g} kg/m^3 are softer than any gel: is "
                       "their unit missing, such as GPa or MPa?", stiffest, density);
  return "";
}

}  // namespace

void add_material_slips(const Subject& subject, Warnings& out) {
  for (const auto& [name, material] : subject.scene.materials) {
    const std::string slip = slip_of(*material);
    if (slip.empty()) continue;
    const auto place = value_at(subject.config, {"materials", name});
    out.push_back(fmt::format("{}: {}", place ? place->where() : "materials." + name, slip));
  }
}

}  // namespace orthodyn::slip
