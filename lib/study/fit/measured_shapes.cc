#include "lib/study/fit/measured_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/config/csv_table.h"
#include "lib/core/spelling.h"
#include "lib/fem/fem_model.h"
#include "lib/study/fit/headings.h"

namespace orthodyn::study::fit {

namespace {

std::string title_of_mode(std::size_t k) { return fmt::format("mode {}", k + 1); }

bool is_title_of_mode(const std::string& name) {
  constexpr std::string_view kMode = "mode ";
  return name.starts_with(kMode) && name.find_first_not_of("0123456789", kMode.size()) == std::string::npos;
}

// The table, with columns by their names without units.
class ShapeTable {
 public:
  ShapeTable(const Measurement& measured, const ModeMatching& matching)
      : measured_(measured), table_(read_csv_with_gaps(*measured.shapes)) {
    for (const std::string& heading : table_.names) names_.push_back(name_in(heading));
    std::vector<std::string> wanted{"x", "y", "z"};
    for (std::size_t k = 0; k < matching.frequencies.size(); ++k)
      if (std::isfinite(matching.frequencies[k])) wanted.push_back(title_of_mode(k));
    for (const std::string& name : names_) {
      if (std::ranges::count(names_, name) > 1) fail(fmt::format("column '{}' occurs twice", name));
      if (std::ranges::count(wanted, name) > 0) continue;
      // Another number than the wanted ones is no misspelling.
      const std::string meant = is_title_of_mode(name) ? "." : did_you_mean(name, wanted, ".");
      fail(fmt::format("column '{}' belongs to no measured frequency, of which there {}{} The columns are {}", name,
                       wanted.size() == 4 ? "is 1" : fmt::format("are {}", wanted.size() - 3), meant, join(wanted)));
    }
    for (const std::string& name : wanted)
      if (std::ranges::count(names_, name) == 0)
        fail(
            fmt::format("column '{}' is missing: the table has x, y, z and a column for each measured frequency, "
                        "here {}",
                        name, join(wanted)));
  }

  std::size_t rows() const { return table_.rows(); }
  std::string where(std::size_t row) const { return table_.where(row); }

  double coordinate(std::size_t row, std::size_t axis) const {
    const std::size_t column = column_of(std::string(1, "xyz"[axis]));
    const double value = table_.at(row, column);
    if (std::isnan(value))
      throw ConfigError(where(row), fmt::format("column {}: the point has no coordinate", names_[column]));
    return value * factor_of(unit_in(table_.names[column]), "m", measured_.origin);
  }

  // Throws ConfigError unless the shape can be compared.
  std::vector<double> shape(std::size_t k) const {
    const std::size_t column = column_of(title_of_mode(k));
    std::vector<double> out;
    std::size_t known = 0;
    double largest = 0;
    for (std::size_t row = 0; row < rows(); ++row) {
      out.push_back(table_.at(row, column));
      if (std::isnan(out.back())) continue;
      ++known, largest = std::max(largest, std::abs(out.back()));
    }
    if (known < 2)
      fail(fmt::format("column '{}' has {}; shapes can be compared from two points on", names_[column],
                       known == 0 ? "no amplitudes" : "one amplitude"));
    if (largest == 0)
      fail(fmt::format("column '{}': all amplitudes are zero; give another direction, or null as frequency {}",
                       names_[column], k + 1));
    return out;
  }

 private:
  std::size_t column_of(const std::string& name) const {
    return static_cast<std::size_t>(std::ranges::find(names_, name) - names_.begin());
  }
  [[noreturn]] void fail(const std::string& message) const {
    measured_.origin.fail(fmt::format("{}: {}", table_.path, message));
  }

  const Measurement& measured_;
  CsvTable table_;
  std::vector<std::string> names_;
};

void require_points_of_body(const ShapeTable& table, const FemModel& model, const ModeMatching& matching) {
  const std::vector<double> distances = distances_from_body(matching, model);
  const double limit = accepted_distance(model);
  for (std::size_t p = 0; p < distances.size(); ++p) {
    if (distances[p] <= limit) continue;
    const double* const at = &matching.points[3 * p];
    throw ConfigError(
        table.where(p),
        fmt::format("the point ({:.4g}, {:.4g}, {:.4g}) m is {:.3g} m away from the body, allowed are "
                    "{:.3g} m (2 % of the body's diagonal): check units and the origin of the coordinates",
                    at[0], at[1], at[2], distances[p], limit));
  }
}

}  // namespace

void read_shapes(const Measurement& measured, const FemModel& model, ModeMatching& matching) {
  const ShapeTable table(measured, matching);
  for (std::size_t row = 0; row < table.rows(); ++row)
    for (std::size_t axis = 0; axis < 3; ++axis) matching.points.push_back(table.coordinate(row, axis));
  for (std::size_t k = 0; k < matching.frequencies.size(); ++k)
    matching.shapes.push_back(std::isfinite(matching.frequencies[k]) ? table.shape(k) : std::vector<double>{});
  const Vec3 direction = measured.direction->normalized();
  matching.direction.assign(direction.begin(), direction.end());
  require_points_of_body(table, model, matching);
}

}  // namespace orthodyn::study::fit
