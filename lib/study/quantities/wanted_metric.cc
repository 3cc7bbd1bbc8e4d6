#include "lib/study/quantities/wanted_metric.h"

#include <algorithm>
#include <stdexcept>

#include "lib/core/spelling.h"
#include "lib/core/units.h"
#include "lib/study/quantities/evaluation_cost.h"

namespace orthodyn {

namespace {

void check_metric(const WantedMetric& m, const Config& config) {
  const int kinds =
      !m.quantity.empty() + (m.mode.has_value() || m.along.has_value()) + m.buckling.has_value() + !m.cost.empty();
  if (kinds != 1) config.fail("give exactly one of: quantity, mode (or along), buckling, cost");
  if (m.mode && m.along) config.at("along").fail("selects a mode by itself; remove 'mode' or 'along'");
  check_take(m.take, m.at, m.of, config);
  if (m.is_of_response()) {
    if (m.quantity.empty() || m.take != TimeReduction::end || m.at || m.of || m.settled_within)
      config.fail(
          "'response' and 'frequency' are for quantities of a harmonic analysis, without take, at, of and "
          "settled_within");
    check_response_metric(m.response_metric(), m.frequency, config);
  }
  if (m.quantity.empty()) m.check_unit("");
  if (m.settled_within && (m.at || m.take != TimeReduction::end))
    config.at("settled_within").fail("replaces 'take' and 'at'; remove them");
  if (m.cost.empty()) return;
  std::vector<std::string> names;
  for (const auto& cost : cost_fields()) names.push_back(cost.name);
  if (std::find(names.begin(), names.end(), m.cost) != names.end()) return;
  config.at("cost").fail("unknown cost '" + m.cost + "'" + did_you_mean(m.cost, names) + " Known: " + join(names));
}

}  // namespace

std::string WantedMetric::unit_of(const std::string& quantity_unit) const {
  if (mode || along) return "Hz";
  if (settled_within) return "s";
  if (is_of_response()) return metric_unit(response_metric(), quantity_unit);
  if (cost.empty()) return metric_unit(take, quantity_unit);
  for (const auto& field : cost_fields())
    if (field.name == cost) return field.unit;
  return "";
}

void WantedMetric::check_unit(const std::string& quantity_unit) const {
  if (unit.empty()) return;
  try {
    check_dimension(unit, unit_of(quantity_unit));
  } catch (const std::invalid_argument& e) {
    origin.fail("unit: '" + unit + "': " + e.what());
  }
}

const Spec<WantedMetric>& WantedMetric::spec() {
  static const auto s =
      Spec<WantedMetric>()
          .key("quantity", &WantedMetric::quantity,
               "A probe's field and component (tip.displacement.z) or a scalar of the whole body (energy.elastic, "
               "tsai_wu.largest), as in the `expect` list of a scene.")
          .key("take", &WantedMetric::take, kTakeSentence)
          .key("at", &WantedMetric::at, "The value at this time, instead of `take`.", {.unit = "s"})
          .key("of", &WantedMetric::of, kOfSentence, {.range = kPositive})
          .key("response", &WantedMetric::response, kResponseSentence)
          .key("frequency", &WantedMetric::frequency, kFrequencySentence, {.unit = "Hz", .range = kPositive})
          .key("settled_within", &WantedMetric::settled_within,
               "Instead of `take`: the time after which the quantity stays within this fraction of its range about its "
               "last value. Undefined if this time is in the last tenth of the time span.",
               {.range = {0, 1, true, true}})
          .key("mode", &WantedMetric::mode, "Natural frequency in Hz by its number, not counting rigid modes.",
               {.range = {1, 1000}})
          .key("along", &WantedMetric::along,
               "Natural frequency in Hz of the mode with the largest effective mass along this axis, among the twenty "
               "lowest modes.")
          .key("about_equilibrium", &WantedMetric::about_equilibrium,
               "Compute modes about the static equilibrium under the scene's loads instead of about the rest shape.")
          .key("buckling", &WantedMetric::buckling,
               "Critical load factor of linear buckling by its number from the lowest.", {.range = {1, 1000}})
          .key("cost", &WantedMetric::cost,
               "A cost of the computation: cpu_seconds, wall_seconds, steps, rejected_steps, newton_iterations, "
               "forces, tangents, factorizations, solves or peak_memory.")
          .key("title", &WantedMetric::title, "Title in plots; default the name.")
          .key("unit", &WantedMetric::unit, "Unit of display, such as mm; default SI.")
          .key("closed_form", &WantedMetric::closed_form,
               "Formula of the varied values and the definitions, in SI units, drawn as a line with the points.")
          .key("scale", &WantedMetric::scale, "Scale of the metric's axis in plots.")
          .check(check_metric);
  return s;
}

}  // namespace orthodyn
