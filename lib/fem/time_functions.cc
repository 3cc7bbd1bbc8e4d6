// constant, ramp, sine, table.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/fem/time_function.h"

namespace orthodyn {
namespace {

class Constant : public TimeFunction {
 public:
  static const Spec<Constant>& spec() {
    static const auto s = Spec<Constant>().key("value", &Constant::value_, "The factor.");
    return s;
  }
  double value(double) const override { return value_; }
  bool constant() const override { return true; }
  double peak() const override { return std::abs(value_); }

 private:
  double value_ = 1;
};

// From 0 at `start` to `value` at `end`, then constant.
class Ramp : public TimeFunction {
 public:
  static const Spec<Ramp>& spec() {
    static const auto s =
        Spec<Ramp>()
            .key("start", &Ramp::start_, "Zero until then.", {.unit = "s"})
            .key("end", &Ramp::end_, "Constant from then on.", {.required = true, .unit = "s"})
            .key("value", &Ramp::value_, "The factor reached at the end.")
            .check([](const Ramp& r, const Config& c) {
              if (!(r.end_ > r.start_)) c.fail("'end' must be after 'start'");
            });
    return s;
  }
  double value(double t) const override {
    return value_ * std::clamp((t - start_) / (end_ - start_), 0.0, 1.0);
  }
  std::vector<double> kinks() const override { return {start_, end_}; }
  double peak() const override { return std::abs(value_); }

 private:
  double start_ = 0, end_ = 0, value_ = 1;
};

class Sine : public TimeFunction {
 public:
  static const Spec<Sine>& spec() {
    static const auto s =
        Spec<Sine>()
            .key("frequency", &Sine::frequency_, "Frequency.",
                 {.required = true, .unit = "Hz", .range = kPositive})
            .key("amplitude", &Sine::amplitude_, "The factor's amplitude.")
            .key("phase", &Sine::phase_, "sin(2 pi frequency t + phase).", {.unit = "rad"});
    return s;
  }
  double value(double t) const override {
    return amplitude_ * std::sin(2 * std::numbers::pi * frequency_ * t + phase_);
  }
  double peak() const override { return std::abs(amplitude_); }

 private:
  double frequency_ = 0, amplitude_ = 1, phase_ = 0;
};

// Piecewise linear, constant beyond its ends.
class Table : public TimeFunction {
 public:
  static const Spec<Table>& spec() {
    static const auto s =
        Spec<Table>()
            .key("points", &Table::points_, "Pairs [time, factor], times ascending.",
                 {.required = true, .unit = "s"})
            .check([](const Table& table, const Config& c) {
              if (table.points_.empty()) c.fail("'points' is empty; give pairs [time, factor]");
              for (std::size_t i = 1; i < table.points_.size(); ++i)
                if (!(table.points_[i][0] > table.points_[i - 1][0]))
                  c.at("points").at(i).fail("times must ascend");
            });
    return s;
  }

  double value(double t) const override {
    const auto next = std::upper_bound(points_.begin(), points_.end(), t,
                                       [](double time, const auto& point) { return time < point[0]; });
    if (next == points_.begin()) return points_.front()[1];
    if (next == points_.end()) return points_.back()[1];
    const auto& a = *(next - 1);
    const auto& b = *next;
    return a[1] + (b[1] - a[1]) * (t - a[0]) / (b[0] - a[0]);
  }

  std::vector<double> kinks() const override {
    std::vector<double> times;
    for (const auto& point : points_) times.push_back(point[0]);
    return times;
  }

  double peak() const override {
    double largest = 0;
    for (const auto& point : points_) largest = std::max(largest, std::abs(point[1]));
    return largest;
  }

 private:
  std::vector<std::array<double, 2>> points_;
};

using R = Registry<TimeFunction>;
const bool registered[] = {
    R::add<Constant>("constant", "The same at all times."),
    R::add<Ramp>("ramp", "Linear from zero to a value, then constant."),
    R::add<Sine>("sine", "A sine."),
    R::add<Table>("table", "Piecewise linear through given points."),
};

}  // namespace
}  // namespace orthodyn
