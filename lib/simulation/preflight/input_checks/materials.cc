// Constants of materials that no solid has, or that do not go with each other.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/ratio_distance.h"
#include "lib/core/symmetric_eigen.h"
#include "lib/core/units.h"
#include "lib/simulation/preflight/input_checks/subject.h"

namespace orthodyn::input_checks {

namespace {

constexpr double kFastest = 25e3;   // m/s; diamond has 18,000
constexpr double kSlowest = 0.3;    // m/s; a gel of 100 Pa has as much
constexpr double kDensest = 30e3;   // kg/m^3; osmium has 22,600
constexpr double kStiffest = 2e12;  // Pa; diamond has 1.3e12
// Between moduli of one material, by which two units are told from two stiffnesses.
constexpr double kMostApart = 300, kUsuallyApart = 60;
constexpr double kMostUnlike = 1e-7;  // of the eigenvalues of C
constexpr double kSoftest = 1e3;      // Pa
constexpr double kWeakest = 1e-6;     // strength over the softest modulus; the weakest woods and foams have 1e-3

// A modulus that the user gave with its unit.
struct Modulus {
  std::string name;
  NumberWithUnit given;
  double si;  // Pa
  std::string text() const { return fmt::format("{} = {:.6g} {}", name, given.number, given.unit); }
};

void add_modulus(const std::string& name, const Config& value, std::vector<Modulus>& all) {
  if (!value.is_scalar() || value.reads_as_number()) return;
  if (const auto given = split_quantity(value.text()))
    all.push_back({name, *given, read_number(value, {.unit = "Pa"})});
}

// [10.8 GPa, 0.84 GPa, 0.46 MPa]: one that is far from all others, and near to them with their unit.
std::string odd_unit(const std::vector<Modulus>& moduli) {
  for (const Modulus& odd : moduli) {
    const Modulus* nearest = nullptr;
    bool fits = true;
    for (const Modulus& other : moduli) {
      if (&other == &odd) continue;
      fits = fits && other.given.unit != odd.given.unit && ratio_distance(other.si, odd.si) > kMostApart &&
             ratio_distance(other.given.number, odd.given.number) < kUsuallyApart;
      if (!nearest || ratio_distance(other.si, odd.si) < ratio_distance(nearest->si, odd.si)) nearest = &other;
    }
    if (nearest && fits)
      return fmt::format("{} is {} times {} than {}: is its unit {}, too?", odd.text(),
                         shown_factor(ratio_distance(odd.si, nearest->si)), odd.si < nearest->si ? "less" : "more",
                         nearest->text(), nearest->given.unit);
  }
  return "";
}

std::string odd_modulus(const Config& material) {
  std::vector<Modulus> young, shear;
  if (material.has("young") && material.at("young").is_sequence())
    for (std::size_t i = 0; i < material.at("young").size(); ++i)
      add_modulus(fmt::format("E{}", i + 1), material.at("young").at(i), young);
  for (const char* key : {"g12", "g23", "g13"})
    if (material.has(key)) add_modulus(key, material.at(key), shear);
  const std::string odd = odd_unit(young);
  return odd.empty() ? odd_unit(shear) : odd;
}

// nu13 of a table that means nu31, which is less by E3/E1: then it is as small as that, and the others are not.
std::string swapped_ratio(const Config& material) {
  constexpr double kStiffer = 5, kSmall = 0.1, kLeastUsual = 0.15, kMostUsual = 0.8;
  if (!material.has("young") || !material.at("young").is_sequence() || material.at("young").size() != 3) return "";
  const auto number = [&](int i, int j) -> std::optional<double> {
    const auto given = value_at(material, {fmt::format("nu{}{}", i, j)});
    if (!given || !given->reads_as_number()) return {};
    return given->number();
  };
  const auto young = [&](int i) {
    return read_number(material.at("young").at(static_cast<std::size_t>(i - 1)), {.unit = "Pa"});
  };
  std::string found;
  bool others_are_usual = false;
  for (int i = 1; i <= 3; ++i)
    for (int j = 1; j <= 3; ++j) {
      const auto nu = i == j ? std::nullopt : number(i, j);
      if (!nu) continue;
      const double ratio = young(i) / young(j), meant = *nu * ratio;
      others_are_usual = others_are_usual || (ratio > 1 && *nu > kLeastUsual);
      if (ratio > kStiffer && *nu > 0 && *nu < kSmall && meant > kLeastUsual && meant < kMostUsual)
        found = fmt::format(
            "nu{0}{1} = {2:.4g} makes nu{1}{0} {3:.2g}, for nu{0}{1}/E{0} = nu{1}{0}/E{1}: is it nu{1}{0} "
            "that is {2:.4g}? Then nu{0}{1} is {4:.3g}",
            i, j, *nu, *nu / ratio, meant);
    }
  return others_are_usual ? found : "";
}

// `given`: as the user wrote it, if he did.
std::string dense_warning(double density, const std::optional<Config>& given) {
  const auto parts = given && given->is_scalar() && !given->reads_as_number() ? split_quantity(given->text())
                                                                              : std::optional<NumberWithUnit>();
  if (!parts || parts->number > kDensest || density > 1000 * kDensest)
    return fmt::format("the density {:.4g} kg/m^3 is beyond that of any metal: is it in g/m^3? Then write {:.4g}",
                       density, density / 1000);
  return fmt::format("the density {} is {:.4g} kg/m^3, beyond that of any metal: is it {:.6g} kg/m^3, or {:.6g} {}?",
                     given->text(), density, parts->number, parts->number / 1000, parts->unit);
}

std::string wave_warning(double wave, double density, double stiffest) {
  const std::string finding =
      fmt::format("waves would travel at {:.3g} m/s, faster than in any solid (diamond: 18000 m/s): ", wave);
  if (stiffest > kStiffest)
    return finding + fmt::format(
                         "moduli of {:.3g} Pa are beyond those of diamond (1.3e+12 Pa). Is their unit GPa or "
                         "MPa?",
                         stiffest);
  return finding + fmt::format(
                       "the density {:.4g} kg/m^3 is too small for moduli up to {:.3g} Pa. Is it in {}? Or are "
                       "the moduli of a wrong unit?",
                       density, stiffest, density < 1e-3 ? "t/mm^3 (orthodyn computes in m, kg, s)" : "g/cm^3");
}

// `given`: the section of the scene, none for a material of the mesh's file.
std::string slip_of(const Material& material, const std::optional<Config>& given) {
  if (given)
    if (const std::string odd = odd_modulus(*given); !odd.empty()) return odd;
  if (given)
    if (const std::string swapped = swapped_ratio(*given); !swapped.empty()) return swapped;
  const double density = material.density(), wave = fastest_wave(material);
  const Vec6 lambda = symmetric_eigenvalues(voigt(material.stiffness()));
  const double stiffest = lambda.maxCoeff(), softest = lambda.minCoeff();
  if (density > kDensest) return dense_warning(density, given ? value_at(*given, {"density"}) : given);
  if (wave > kFastest) return wave_warning(wave, density, stiffest);
  if (softest < kMostUnlike * stiffest)
    return fmt::format(
        "its moduli differ by a factor {:.1g} (eigenvalues of C {:.3g} to {:.3g} Pa): does one of them "
        "lack its unit, such as GPa?",
        stiffest / softest, softest, stiffest);
  if (const auto strength = material.strength()) {
    const double weakest =
        std::min({strength->tension.minCoeff(), strength->compression.minCoeff(), strength->shear.minCoeff()});
    if (weakest > 0 && weakest < kWeakest * softest)
      return fmt::format(
          "its strength of {:.3g} Pa is {:.1g} of its softest modulus, and is passed at once: is the "
          "unit missing, such as MPa?",
          weakest, weakest / softest);
  }
  if (wave < kSlowest && stiffest < kSoftest)
    return fmt::format(
        "its moduli of at most {:.3g} Pa at a density of {:.4g} kg/m^3 are softer than any gel: is "
        "their unit missing, such as GPa or MPa?",
        stiffest, density);
  return "";
}

}  // namespace

void check_material(const Subject& subject, Warnings& out) {
  for (const auto& [name, material] : subject.scene.materials) {
    const auto place = value_at(subject.config, {"materials", name});
    const std::string slip = slip_of(*material, place);
    if (slip.empty()) continue;
    out.push_back(fmt::format("{}: {}", place ? place->where() : "materials." + name, slip));
  }
}

}  // namespace orthodyn::input_checks
