// A metric requested of each point of a study: a reduction of a quantity over time, a natural frequency, a critical
// load factor, or a cost. Exactly one of `quantity`, `mode` (or `along`), `buckling` and `cost` is set.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/fem/motion/support_motion.h"
#include "lib/scene/expectation.h"

namespace orthodyn {

// Scale of plot axes and of ranges.
enum class Scale { linear, log };

template <>
struct EnumNames<Scale> {
  static constexpr std::array<std::pair<Scale, const char*>, 2> list{{{Scale::linear, "linear"}, {Scale::log, "log"}}};
};

struct WantedMetric {
  std::string quantity = {};
  TimeReduction take = TimeReduction::end;
  std::optional<double> at = {}, of = {}, settled_within = {};
  std::optional<ResponseMetric> response = {};  // in a harmonic analysis, instead of `take`
  std::optional<double> frequency = {};         // of the response, Hz
  std::optional<int> mode = {};
  // Of a study: index of the ModeMatching that says which computed mode `mode` is; `mode` is then the number of the
  // measured frequency, from 1.
  std::optional<int> matching = {};
  std::optional<Component> along = {};  // instead of `mode`: the mode with the largest effective mass along this axis
  bool about_equilibrium = false;
  std::optional<int> buckling = {};
  std::string cost = {};
  std::string title = {}, unit = {}, closed_form = {};
  Scale scale = Scale::linear;
  SourceLocation origin = {};
  static const Spec<WantedMetric>& spec();

  // True if the metric needs a motion or an equilibrium.
  bool is_of_motion() const { return !quantity.empty() || !cost.empty(); }
  // True if the metric is of the response in a harmonic analysis.
  bool is_of_response() const { return response || frequency; }
  ResponseMetric response_metric() const { return response.value_or(default_response(frequency)); }
  // SI unit of the metric, given that of its quantity; "" for a plain number.
  std::string unit_of(const std::string& quantity_unit) const;
  // Throws ConfigError if `unit` has another dimension.
  void check_unit(const std::string& quantity_unit) const;
};

}  // namespace orthodyn
