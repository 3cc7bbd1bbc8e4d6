#include <algorithm>
#include <cmath>

#include "lib/fem/time_functions/time_function.h"

namespace orthodyn {
namespace {

// Piecewise linear between its points, constant outside.
class Table : public TimeFunction {
 public:
  static const Spec<Table>& spec() {
    static const auto s =
        Spec<Table>()
            .key("points", &Table::points_, "Pairs [time, factor], times ascending.", {.required = true, .unit = "s"})
            .check([](const Table& table, const Config& c) {
              if (table.points_.empty()) c.fail("'points' is empty; give pairs [time, factor]");
              for (std::size_t i = 1; i < table.points_.size(); ++i)
                if (!(table.points_[i][0] > table.points_[i - 1][0])) c.at("points").at(i).fail("times must ascend");
            });
    return s;
  }

  double value(double t) const override {
    const auto next = first_after(t);
    if (next == points_.begin()) return points_.front()[1];
    if (next == points_.end()) return points_.back()[1];
    const auto& a = *(next - 1);
    const auto& b = *next;
    return a[1] + (b[1] - a[1]) * (t - a[0]) / (b[0] - a[0]);
  }

  double rate(double t) const override {
    const auto next = first_after(t);
    if (next == points_.begin() || next == points_.end()) return 0;
    const auto& a = *(next - 1);
    const auto& b = *next;
    return (b[1] - a[1]) / (b[0] - a[0]);
  }

  double curvature(double) const override { return 0; }

  std::vector<double> kinks() const override {
    std::vector<double> times;
    for (const auto& point : points_) times.push_back(point[0]);
    return times;
  }

  double peak(double, double) const override {
    double largest = 0;
    for (const auto& point : points_) largest = std::max(largest, std::abs(point[1]));
    return largest;
  }

 private:
  using Points = std::vector<std::array<double, 2>>;

  Points::const_iterator first_after(double t) const {
    return std::upper_bound(points_.begin(), points_.end(), t,
                            [](double time, const auto& point) { return time < point[0]; });
  }

  Points points_;
};

const bool table_registered = Registry<TimeFunction>::add<Table>("table", "Piecewise linear through given points.");

}  // namespace
}  // namespace orthodyn
