// A metric that a sweep wants of each point: of a quantity's course over time, a natural frequency, a critical load
// factor, or a cost.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/fem/motion/component.h"
#include "lib/scene/expectation.h"

namespace orthodyn {

// Of the axes of plots, and of ranges.
enum class Scale { linear, log };

template <>
struct EnumNames<Scale> {
  static constexpr std::array<std::pair<Scale, const char*>, 2> list{{{Scale::linear, "linear"}, {Scale::log, "log"}}};
};

// Exactly one of: quantity, mode (or along), buckling, cost.
struct WantedMetric {
  std::string quantity = {};
  Take take = Take::end;
  std::optional<double> at = {}, of = {}, settled_within = {};
  std::optional<int> mode = {};
  std::optional<Component> along = {};  // in place of the mode's number: that with the largest effective mass along it
  bool about_equilibrium = false;
  std::optional<int> buckling = {};
  std::string cost = {};
  std::string title = {}, unit = {}, closed_form = {};
  Scale scale = Scale::linear;
  SourceLocation origin = {};
  static const Spec<WantedMetric>& spec();

  bool is_of_motion() const { return !quantity.empty() || !cost.empty(); }
  // Its SI unit, where its quantity has the given one; "" for a plain number.
  std::string unit_of(const std::string& quantity_unit) const;
  // Throws ConfigError if it cannot be shown in `unit`.
  void check_unit(const std::string& quantity_unit) const;
};

// What a point can have cost, by name: "cpu_seconds", "steps", ... with their units.
const std::vector<std::pair<std::string, std::string>>& cost_names();

}  // namespace orthodyn
