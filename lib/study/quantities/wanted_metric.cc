#include "lib/study/quantities/wanted_metric.h"

#include <algorithm>
#include <stdexcept>

#include "lib/core/spelling.h"
#include "lib/core/units.h"

namespace orthodyn {

namespace {

void check_metric(const WantedMetric& f, const Config& config) {
  const int kinds =
      !f.quantity.empty() + (f.mode.has_value() || f.along.has_value()) + f.buckling.has_value() + !f.cost.empty();
  if (kinds != 1) config.fail("give exactly one of: quantity, mode (or along), buckling, cost");
  if (f.mode && f.along) config.at("along").fail("finds a mode by itself; remove 'mode' or 'along'");
  check_take(f.take, f.at, f.of, config);
  if (f.quantity.empty()) f.check_unit("");
  if (f.settled_within && (f.at || f.take != Take::end))
    config.at("settled_within").fail("replaces 'take' and 'at'; remove them");
  const auto& costs = cost_names();
  if (f.cost.empty() || std::any_of(costs.begin(), costs.end(), [&](const auto& c) { return c.first == f.cost; }))
    return;
  std::vector<std::string> names;
  for (const auto& [name, unit] : costs) names.push_back(name);
  config.at("cost").fail("unknown cost '" + f.cost + "'" + did_you_mean(f.cost, names) + " Known: " + join(names));
}

}  // namespace

const std::vector<std::pair<std::string, std::string>>& cost_names() {
  static const std::vector<std::pair<std::string, std::string>> all = {
      {"cpu_seconds", "s"},    {"wall_seconds", "s"},     {"steps", ""},
      {"rejected_steps", ""},  {"newton_iterations", ""}, {"forces", ""},
      {"tangents", ""},        {"factorizations", ""},    {"solves", ""},
      {"peak_memory", "bytes"}};
  return all;
}

std::string WantedMetric::unit_of(const std::string& quantity_unit) const {
  if (mode || along) return "Hz";
  if (settled_within) return "s";
  if (cost.empty()) return metric_unit(take, quantity_unit);
  for (const auto& [name, si] : cost_names())
    if (name == cost) return si;
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
               "tsai_wu.largest), as in `expect` of a scene.")
          .key("take", &WantedMetric::take, kTakeSentence)
          .key("at", &WantedMetric::at, "The value at this time, instead of `take`.", {.unit = "s"})
          .key("of", &WantedMetric::of, kOfSentence, {.range = kPositive})
          .key("settled_within", &WantedMetric::settled_within,
               "Instead of `take`: the time after which the quantity stays within this fraction of its range about its "
               "last value. None if that is in the last tenth of the time span.",
               {.range = {0, 1, true, true}})
          .key("mode", &WantedMetric::mode, "A natural frequency in Hz by its number, rigid modes not counted.",
               {.range = {1, 1000}})
          .key("along", &WantedMetric::along,
               "A natural frequency: among the twenty lowest modes, the one with the largest effective mass along this "
               "axis.")
          .key("about_equilibrium", &WantedMetric::about_equilibrium,
               "Modes about the static equilibrium under the scene's loads, not about rest.")
          .key("buckling", &WantedMetric::buckling,
               "The load factor at which the body at rest would buckle (linear), by its number from the lowest.",
               {.range = {1, 1000}})
          .key(
              "cost", &WantedMetric::cost,
              "A cost of the computation: cpu_seconds, wall_seconds, steps, rejected_steps, newton_iterations, forces, "
              "tangents, factorizations, solves or peak_memory.")
          .key("title", &WantedMetric::title, "Its title in metrics; default its name.")
          .key("unit", &WantedMetric::unit, "The unit it is shown in, such as mm; default SI.")
          .key("closed_form", &WantedMetric::closed_form,
               "A formula of the varied values and the definitions, in SI units: drawn as a line over the points.")
          .key("scale", &WantedMetric::scale, "Scale of its axis in metrics.")
          .check(check_metric);
  return s;
}

}  // namespace orthodyn
