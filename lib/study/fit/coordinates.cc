#include "lib/study/fit/coordinates.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "lib/config/values.h"
#include "lib/simulation/sensitivity/scene_parameter.h"

namespace orthodyn::study::fit {

namespace {

using Complex = Coordinates::Complex;
using Values = std::vector<Complex>;

constexpr double kComplexStep = 1e-30;  // of complex steps, which have no rounding errors
constexpr double kInterior = 1 - 1e-6;  // share of a ratio's interval, so that no point is on the edge of stability

Complex logistic(Complex z) { return 1.0 / (1.0 + std::exp(-z)); }

// The interval without its edges.
std::pair<Complex, Complex> interior(const std::pair<Complex, Complex>& ends) {
  const Complex middle = 0.5 * (ends.first + ends.second), half = 0.5 * kInterior * (ends.second - ends.first);
  return {middle - half, middle + half};
}

// "materials.spruce.nu12" as {"spruce", "nu12"}.
struct MaterialKey {
  std::string material, key;
};

std::optional<MaterialKey> material_key(const std::string& path) {
  const std::string first = "materials.";
  if (!path.starts_with(first)) return {};
  const auto dot = path.find('.', first.size());
  if (dot == std::string::npos) return {};
  return MaterialKey{path.substr(first.size(), dot - first.size()), path.substr(dot + 1)};
}

std::string type_of(const std::string& material, const Config& scene) {
  const Config section = scene.at("materials").at(material);
  return section.is_map() && section.has("type") ? section.at("type").text() : "";
}

const std::map<std::string, std::vector<std::string>>& ratios_of_types() {
  static const std::map<std::string, std::vector<std::string>> all{
      {"orthotropic", {"nu12", "nu21", "nu23", "nu32", "nu13", "nu31"}},
      {"transversely_isotropic", {"nu_axial", "nu_transverse"}},
      {"orthotropic_stable", {"nu"}},
      {"isotropic", {"nu"}}};
  return all;
}

// The constants of one material, of which some are parameters.
class Constants {
 public:
  Constants(const Config& section, std::map<std::string, std::size_t> parameters)
      : section_(section), parameters_(std::move(parameters)) {}

  bool has(const std::string& key) const { return section_.has(key); }
  std::optional<std::size_t> parameter(const std::string& key) const {
    const auto found = parameters_.find(key);
    return found == parameters_.end() ? std::nullopt : std::optional(found->second);
  }
  // `unit`: SI.
  Constant at(const std::string& key, const std::string& unit) const {
    if (const auto own = parameter(key)) return {own, 0};
    return {{}, read_number(value_at(section_, key), {.unit = unit})};
  }
  Constant young(int axis) const { return at(fmt::format("young.{}", axis), "Pa"); }
  [[noreturn]] void fail(const std::string& message) const { section_.fail(message); }

 private:
  Config section_;
  std::map<std::string, std::size_t> parameters_;  // by key
};

// One of the ratios nu_ij of an orthotropic material.
struct Ratio {
  Constant nu;
  Constant stretched, across;  // E_i and E_j

  // r = nu_ij sqrt(E_j / E_i).
  Complex scaled(const Values& values) const { return nu.of(values) * unscale(values); }
  Complex unscale(const Values& values) const { return std::sqrt(across.of(values) / stretched.of(values)); }
};

// The ratio of the axes i and j. If the material has nu_ji, the axes are exchanged.
Ratio ratio_of(const Constants& constants, int i, int j) {
  const std::string ij = fmt::format("nu{}{}", i + 1, j + 1), ji = fmt::format("nu{}{}", j + 1, i + 1);
  if (constants.has(ij) && constants.has(ji))
    constants.fail(fmt::format("{} and {} are the same constant; a fit needs one of them only", ij, ji));
  if (constants.has(ij)) return {constants.at(ij, ""), constants.young(i), constants.young(j)};
  return {constants.at(ji, ""), constants.young(j), constants.young(i)};
}

void set_orthotropic(Coordinates& coordinates, const Constants& constants) {
  // In the order of fitted ones: each has the interval that the fixed and the earlier ones leave.
  const std::array<Ratio, 3> ratios{ratio_of(constants, 0, 1), ratio_of(constants, 0, 2), ratio_of(constants, 1, 2)};
  std::vector<Ratio> known;
  for (const Ratio& ratio : ratios)
    if (!ratio.nu.parameter) known.push_back(ratio);
  for (const Ratio& ratio : ratios) {
    if (!ratio.nu.parameter) continue;
    if (!coordinates.is_ratio(*ratio.nu.parameter)) continue;
    coordinates.set_interval(*ratio.nu.parameter, [ratio, known](const Values& values) {
      Complex middle = 0, half = 1;
      if (known.size() == 2) {
        const Complex a = known[0].scaled(values), b = known[1].scaled(values);
        middle = -a * b, half = std::sqrt((1.0 - a * a) * (1.0 - b * b));
      }
      const Complex scale = ratio.unscale(values);
      return std::pair{(middle - half) / scale, (middle + half) / scale};
    });
    known.push_back(ratio);
  }
}

// Stable if |nu23| < 1 and 1 - nu23 - 2 nu12^2 E2 / E1 > 0 (lib/material/transversely_isotropic.cc).
void set_transverse(Coordinates& coordinates, const Constants& constants) {
  const Constant along = constants.at("young_axial", "Pa"), across = constants.at("young_transverse", "Pa");
  const Constant axial = constants.at("nu_axial", ""), transverse = constants.at("nu_transverse", "");
  if (transverse.parameter && coordinates.is_ratio(*transverse.parameter))
    coordinates.set_interval(*transverse.parameter, [=](const Values& values) {
      if (axial.parameter) return std::pair{Complex(-1), Complex(1)};
      const double nu = axial.number;
      return std::pair{Complex(-1), 1.0 - 2 * nu * nu * across.of(values) / along.of(values)};
    });
  if (axial.parameter && coordinates.is_ratio(*axial.parameter))
    coordinates.set_interval(*axial.parameter, [=](const Values& values) {
      const Complex half = std::sqrt((1.0 - transverse.of(values)) * along.of(values) / (2.0 * across.of(values)));
      return std::pair{-half, half};
    });
}

}  // namespace

void Coordinates::add_log() { transforms_.push_back({Kind::log, 1, {}}); }
void Coordinates::add_linear(double scale) { transforms_.push_back({Kind::linear, scale, {}}); }

void Coordinates::set_interval(std::size_t parameter, Interval interval) {
  transforms_[parameter].interval = std::move(interval);
  order_.push_back(parameter);
}

std::vector<Complex> Coordinates::complex_values(const std::vector<Complex>& z) const {
  Values values(size());
  for (std::size_t i = 0; i < size(); ++i) {
    if (transforms_[i].kind == Kind::log) values[i] = std::exp(z[i]);
    if (transforms_[i].kind == Kind::linear) values[i] = transforms_[i].scale * z[i];
  }
  for (const std::size_t i : order_) {
    const auto [low, high] = interior(transforms_[i].interval(values));
    values[i] = low.real() < high.real() && std::abs(high.imag()) < 0.5 * std::abs(high - low)
                    ? low + (high - low) * logistic(z[i])
                    : std::numeric_limits<double>::quiet_NaN();
  }
  return values;
}

Vector Coordinates::values(const Vector& z) const {
  const Values all = complex_values({z.begin(), z.end()});
  Vector out(z.size());
  for (Eigen::Index i = 0; i < out.size(); ++i) out[i] = all[static_cast<std::size_t>(i)].real();
  return out;
}

Eigen::MatrixXd Coordinates::derivatives(const Vector& z) const {
  Eigen::MatrixXd out(z.size(), z.size());
  for (Eigen::Index j = 0; j < z.size(); ++j) {
    Values moved(z.begin(), z.end());
    moved[static_cast<std::size_t>(j)] += Complex(0, kComplexStep);
    const Values all = complex_values(moved);
    for (Eigen::Index i = 0; i < z.size(); ++i) out(i, j) = all[static_cast<std::size_t>(i)].imag() / kComplexStep;
  }
  return out;
}

double Coordinates::at(std::size_t parameter, double value) const {
  const Transform& transform = transforms_[parameter];
  return transform.kind == Kind::log ? std::log(value) : value / transform.scale;
}

Vector Coordinates::at(const Vector& values) const {
  Vector z(values.size());
  for (std::size_t i = 0; i < size(); ++i)
    if (!is_ratio(i)) z[static_cast<Eigen::Index>(i)] = at(i, values[static_cast<Eigen::Index>(i)]);
  const Values all(values.begin(), values.end());
  for (const std::size_t i : order_) {
    const auto [low, high] = interior(transforms_[i].interval(all));
    const double share = (all[i].real() - low.real()) / (high.real() - low.real());
    z[static_cast<Eigen::Index>(i)] = std::log(share / (1 - share));
  }
  return z;
}

bool is_poisson_ratio(const std::string& path, const Config& scene) {
  const auto key = material_key(path);
  if (!key) return false;
  const auto found = ratios_of_types().find(type_of(key->material, scene));
  return found != ratios_of_types().end() && std::ranges::count(found->second, key->key) > 0;
}

void set_intervals(Coordinates& coordinates, const std::vector<PathOfParameter>& paths) {
  std::map<std::string, std::map<std::string, std::size_t>> parameters;  // by material, then by key
  std::map<std::string, Config> scenes;
  for (const PathOfParameter& one : paths) {
    const auto key = material_key(one.path);
    if (!key) continue;
    parameters[key->material].emplace(key->key, one.parameter);
    if (coordinates.is_ratio(one.parameter)) scenes.emplace(key->material, one.scene);
  }
  for (const auto& [material, scene] : scenes) {
    const Constants constants(scene.at("materials").at(material), parameters[material]);
    const std::string type = type_of(material, scene);
    if (type == "orthotropic") set_orthotropic(coordinates, constants);
    if (type == "transversely_isotropic") set_transverse(coordinates, constants);
    if (type == "orthotropic_stable" || type == "isotropic")
      coordinates.set_interval(*constants.parameter("nu"), [](const Values&) {
        return std::pair{Complex(-1), Complex(0.5)};
      });
  }
}

}  // namespace orthodyn::study::fit
