#include "lib/study/fit/field_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "lib/study/jobs/json_values.h"

namespace orthodyn::study::fit {

namespace {

constexpr double kHalfWidth95 = 1.96;  // half width over the standard deviation

std::span<const Estimate> estimates_of(const Result& result, const ParameterField& field) {
  return std::span(result.statistics.estimates).subspan(field.first, field.size());
}

// "(0.3, 0.02, 0.01) m".
std::string place_of(const ParameterField& field, std::size_t cell) {
  const Vec3 centre = field.factors.centre(static_cast<int>(cell), field.box);
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) m", centre[0], centre[1], centre[2]);
}

// Half of the 95 % interval of a factor as its fraction.
double half_width(const Estimate& estimate) { return kHalfWidth95 * estimate.deviation_z; }

}  // namespace

Json field_json(const Problem& problem, const Result& result, const ParameterField& field) {
  Json out{{"name", field.name},
           {"path", field.path},
           {"grid", field.factors.grid},
           {"smoothness", field.smoothness},
           {"min", {field.box.min[0], field.box.min[1], field.box.min[2]}},
           {"max", {field.box.max[0], field.box.max[1], field.box.max[2]}},
           {"start", problem.parameters()[field.first].start}};
  for (const char* key : {"factors", "low", "high"}) out[key] = Json::array();
  for (const Estimate& estimate : estimates_of(result, field)) {
    out["factors"].push_back(finite_or_null(estimate.value));
    out["low"].push_back(finite_or_null(estimate.low));
    out["high"].push_back(finite_or_null(estimate.high));
  }
  return out;
}

std::string field_csv(const Json& field) {
  StiffnessFactors factors;
  factors.grid = field.at("grid").get<std::array<int, 3>>();
  Box box;
  for (Eigen::Index a = 0; a < 3; ++a) {
    box.min[a] = field.at("min").at(static_cast<std::size_t>(a)).get<double>();
    box.max[a] = field.at("max").at(static_cast<std::size_t>(a)).get<double>();
  }
  const auto& grid = factors.grid;
  const auto shown = [&](const char* key, std::size_t cell) {
    const Json& value = field.at(key).at(cell);
    return value.is_null() ? std::string() : fmt::format("{:.8g}", value.get<double>());
  };
  std::string out = "i,j,k,x [m],y [m],z [m],factor,low,high\n";
  for (std::size_t cell = 0; cell < field.at("factors").size(); ++cell) {
    const int number = static_cast<int>(cell);
    const Vec3 centre = factors.centre(number, box);
    out += fmt::format("{},{},{},{:.6g},{:.6g},{:.6g},{},{},{}\n", number % grid[0] + 1, number / grid[0] % grid[1] + 1,
                       number / (grid[0] * grid[1]) + 1, centre[0], centre[1], centre[2], shown("factors", cell),
                       shown("low", cell), shown("high", cell));
  }
  return out;
}

std::string field_sentence(const Result& result, const ParameterField& field) {
  const auto all = estimates_of(result, field);
  const auto [smallest, largest] = std::ranges::minmax_element(all, {}, &Estimate::value);
  const auto [sharpest, widest] = std::ranges::minmax_element(all, {}, &Estimate::deviation_z);
  const std::string range =
      fmt::format("{}: {} factors from {:.3g} at {} to {:.3g} at {}", field.name, all.size(), smallest->value,
                  place_of(field, static_cast<std::size_t>(smallest - all.begin())), largest->value,
                  place_of(field, static_cast<std::size_t>(largest - all.begin())));
  if (!std::isfinite(half_width(*widest)))
    return range + ". The data do not determine their level: fix the moduli of the region, or give the field a prior.";
  return fmt::format("{}. Given the smoothness, their 95 % intervals are ±{:.2g} % to ±{:.2g} %.", range,
                     100 * half_width(*sharpest), 100 * half_width(*widest));
}

std::vector<std::string> field_warnings(const Result& result, const ParameterField& field) {
  std::vector<std::string> out;
  const auto all = estimates_of(result, field);
  if (const auto count = std::ranges::count_if(all, &Estimate::at_bound); count > 0)
    out.push_back(
        fmt::format("{}: {} of {} factors {} at a bound", field.name, count, all.size(), count == 1 ? "is" : "are"));
  if (!result.shift) return out;
  std::size_t moved = 0;
  for (std::size_t cell = 0; cell < all.size(); ++cell) {
    const double shift = (*result.shift)[static_cast<Eigen::Index>(field.first + cell)];
    if (std::abs(shift) > kHalfWidth95 * all[cell].deviation) ++moved;
  }
  if (moved > 0)
    out.push_back(fmt::format(
        "{}: refining the meshes once moves {} of {} factors by more than their 95 % intervals: use finer meshes",
        field.name, moved, all.size()));
  return out;
}

}  // namespace orthodyn::study::fit
