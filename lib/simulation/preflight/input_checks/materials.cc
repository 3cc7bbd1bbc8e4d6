// Material constants that no solid has, or that contradict each other.

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/ratio_distance.h"
#include "lib/core/symmetric_eigen.h"
#include "lib/core/units.h"
#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn::input_checks {

namespace {

constexpr double kFastest = 25e3;   // m/s; diamond: 18,000
constexpr double kSlowest = 0.3;    // m/s; as in a gel of 100 Pa
constexpr double kDensest = 30e3;   // kg/m^3; osmium: 22,600
constexpr double kStiffest = 2e12;  // Pa; diamond: 1.3e12
// Ratios of moduli of one material: above kMaxApart their units probably differ; below kUsuallyApart they are usual.
constexpr double kMaxApart = 300, kUsuallyApart = 60;
constexpr double kMaxUnlike = 1e-7;  // least ratio of the smallest to the largest eigenvalue of C
constexpr double kSoftest = 1e3;     // Pa
constexpr double kWeakest = 1e-6;    // strength over the softest modulus; the weakest woods and foams: 1e-3

// A modulus given with a unit.
struct Modulus {
  std::string name;
  NumberWithUnit input;
  double si;  // Pa
  std::string text() const { return fmt::format("{} = {:.6g} {}", name, input.number, input.unit); }
};

void add_modulus(const std::string& name, const Config& value, std::vector<Modulus>& all) {
  if (!value.is_scalar() || value.reads_as_number()) return;
  if (const auto input = split_quantity(value.text()))
    all.push_back({name, *input, read_number(value, {.unit = "Pa"})});
}

// Warns of a modulus that is far from all others but would be near to them in their unit, such as the last of [10.8
// GPa, 0.84 GPa, 0.46 MPa].
std::string odd_unit(const std::vector<Modulus>& moduli) {
  for (const Modulus& odd : moduli) {
    const Modulus* nearest = nullptr;
    bool fits = true;
    for (const Modulus& other : moduli) {
      if (&other == &odd) continue;
      fits = fits && other.input.unit != odd.input.unit && ratio_distance(other.si, odd.si) > kMaxApart &&
             ratio_distance(other.input.number, odd.input.number) < kUsuallyApart;
      if (!nearest || ratio_distance(other.si, odd.si) < ratio_distance(nearest->si, odd.si)) nearest = &other;
    }
    if (nearest && fits)
      return fmt::format("{} is {} times {} than {}: is its unit {}, too?", odd.text(),
                         factor_text(ratio_distance(odd.si, nearest->si)), odd.si < nearest->si ? "less" : "more",
                         nearest->text(), nearest->input.unit);
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

// Warns of a value of nu31 given as nu13, with nu31 = nu13 E3/E1. If E1 is much larger than E3, such a value is far
// smaller than the other ratios.
std::string swapped_ratio(const Config& material) {
  constexpr double kStiffer = 5, kSmall = 0.1, kLeastUsual = 0.15, kMaxUsual = 0.8;
  if (!material.has("young") || !material.at("young").is_sequence() || material.at("young").size() != 3) return "";
  const auto number = [&](int i, int j) -> std::optional<double> {
    const auto value = find_value(material, {fmt::format("nu{}{}", i, j)});
    if (!value || !value->reads_as_number()) return {};
    return value->number();
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
      if (ratio > kStiffer && *nu > 0 && *nu < kSmall && meant > kLeastUsual && meant < kMaxUsual)
        found = fmt::format(
            "nu{0}{1} = {2:.4g} makes nu{1}{0} {3:.2g}, for nu{0}{1}/E{0} = nu{1}{0}/E{1}: is {2:.4g} the value of "
            "nu{1}{0}? Then nu{0}{1} is {4:.3g}",
            i, j, *nu, *nu / ratio, meant);
    }
  return others_are_usual ? found : "";
}

// `input`: the value in the input, if present.
std::string dense_warning(double density, const std::optional<Config>& input) {
  const auto parts = input && input->is_scalar() && !input->reads_as_number() ? split_quantity(input->text())
                                                                              : std::optional<NumberWithUnit>();
  if (!parts || parts->number > kDensest || density > 1000 * kDensest)
    return fmt::format("the density {:.4g} kg/m^3 is beyond that of any metal: is it in g/m^3? Then write {:.4g}",
                       density, density / 1000);
  return fmt::format("the density {} is {:.4g} kg/m^3, beyond that of any metal: is it {:.6g} kg/m^3, or {:.6g} {}?",
                     input->text(), density, parts->number, parts->number / 1000, parts->unit);
}

std::string wave_warning(double wave, double density, double stiffest) {
  const std::string finding =
      fmt::format("waves would travel at {:.3g} m/s, faster than in any solid (diamond: 18000 m/s): ", wave);
  if (stiffest > kStiffest)
    return finding +
           fmt::format("moduli of {:.3g} Pa are beyond those of diamond (1.3e+12 Pa). Is their unit GPa or MPa?",
                       stiffest);
  return finding + fmt::format(
                       "the density {:.4g} kg/m^3 is too small for moduli up to {:.3g} Pa. Is it in {}? Or do the "
                       "moduli have a wrong unit?",
                       density, stiffest, density < 1e-3 ? "t/mm^3 (orthodyn computes in m, kg, s)" : "g/cm^3");
}

// The most likely error in a material's constants; "" if there is none. `section`: its section of the scene; empty for
// a material of the mesh file.
std::string unlikely_constant(const Material& material, const std::optional<Config>& section) {
  if (section)
    if (const std::string odd = odd_modulus(*section); !odd.empty()) return odd;
  if (section)
    if (const std::string swapped = swapped_ratio(*section); !swapped.empty()) return swapped;
  const Mat6 C = voigt(material.stiffness());
  const double density = material.density(), wave = fastest_wave(C, density);
  const Vec6 lambda = symmetric_eigenvalues(C);
  const double stiffest = lambda.maxCoeff(), softest = lambda.minCoeff();
  if (density > kDensest) return dense_warning(density, section ? find_value(*section, {"density"}) : section);
  if (wave > kFastest) return wave_warning(wave, density, stiffest);
  if (softest < kMaxUnlike * stiffest)
    return fmt::format(
        "its moduli differ by a factor {:.1g} (eigenvalues of C {:.3g} to {:.3g} Pa): does one of them lack its unit, "
        "such as GPa?",
        stiffest / softest, softest, stiffest);
  if (const auto strength = material.strength()) {
    const double weakest =
        std::min({strength->tension.minCoeff(), strength->compression.minCoeff(), strength->shear.minCoeff()});
    if (weakest > 0 && weakest < kWeakest * softest)
      return fmt::format(
          "its strength of {:.3g} Pa is {:.1g} of its softest modulus, and is exceeded at once: is the unit missing, "
          "such as MPa?",
          weakest, weakest / softest);
  }
  if (wave < kSlowest && stiffest < kSoftest)
    return fmt::format(
        "its moduli of at most {:.3g} Pa at a density of {:.4g} kg/m^3 are softer than any gel: is their unit missing, "
        "such as GPa or MPa?",
        stiffest, density);
  return "";
}

}  // namespace

void check_material(const CheckContext& context, Warnings& out) {
  for (const auto& [name, material] : context.scene.materials) {
    const auto place = find_value(context.config, {"materials", name});
    const std::string finding = unlikely_constant(*material, place);
    if (finding.empty()) continue;
    warn(out, place ? place->where() : "materials." + name, "{}", finding);
  }
}

}  // namespace orthodyn::input_checks
