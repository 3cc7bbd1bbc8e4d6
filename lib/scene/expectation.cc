#include "lib/scene/expectation.h"

#include <fmt/format.h>

#include <cmath>

namespace orthodyn {

namespace {

void check_expectation(const Expectation& e, const Config& config) {
  if (!e.quantity.empty() + e.mode.has_value() + e.buckling.has_value() != 1)
    config.fail("give exactly one of: quantity, mode, buckling");
  if (e.is_eigenvalue() && (e.take != TimeReduction::end || e.at || e.of))
    config.fail("'take', 'at' and 'of' are for quantities; a mode or a critical load factor has a single value");
  if (e.relative.has_value() == e.absolute.has_value()) config.fail("give exactly one of relative, absolute");
  if (e.relative && e.value == 0) config.at("relative").fail("cannot be used with the value 0; give 'absolute'");
  check_take(e.take, e.at, e.of, config);
  if (e.response || e.frequency) {
    if (e.is_eigenvalue() || e.take != TimeReduction::end || e.at || e.of)
      config.fail("'response' and 'frequency' are for quantities of a harmonic analysis, without take, at and of");
    check_response_metric(e.response_metric(), e.frequency, config);
  }
  if (e.source.empty()) config.at("source").fail("is empty; give the source of the value");
  if (e.reason.empty()) config.at("reason").fail("is empty; give the reason for this tolerance");
}

}  // namespace

void check_take(TimeReduction take, const std::optional<double>& at, const std::optional<double>& of,
                const Config& config) {
  if (at && take != TimeReduction::end) config.at("at").fail("replaces 'take'; remove one of them");
  const bool compares = take == TimeReduction::drift || take == TimeReduction::gain || take == TimeReduction::onset;
  if (of && !compares) config.at("of").fail("is used with take: drift, gain or onset only");
  if (!of && take == TimeReduction::onset) config.fail("take: onset needs 'of', the threshold");
}

ResponseMetric default_response(const std::optional<double>& frequency) {
  return frequency ? ResponseMetric::amplitude : ResponseMetric::peak;
}

void check_response_metric(ResponseMetric response, const std::optional<double>& frequency, const Config& config) {
  const bool is_peak = response == ResponseMetric::peak || response == ResponseMetric::peak_frequency;
  if (is_peak && frequency) config.at("frequency").fail("is for amplitude and phase; a peak has its own frequency");
  if (!is_peak && !frequency) config.fail("key 'frequency' is missing: amplitude and phase are those at a frequency");
}

std::string metric_unit(ResponseMetric response, const std::string& quantity_unit) {
  if (response == ResponseMetric::phase) return "rad";
  return response == ResponseMetric::peak_frequency ? "Hz" : quantity_unit;
}

std::string response_title(ResponseMetric response, const std::string& quantity,
                           const std::optional<double>& frequency) {
  switch (response) {
    case ResponseMetric::peak: return fmt::format("largest amplitude of {}", quantity);
    case ResponseMetric::peak_frequency: return fmt::format("frequency of the largest amplitude of {}", quantity);
    case ResponseMetric::amplitude:
    case ResponseMetric::phase: break;
  }
  return fmt::format("{} of {} at {:.6g} Hz", Value<ResponseMetric>::yaml(response), quantity, *frequency);
}

std::string metric_unit(TimeReduction take, const std::string& quantity_unit) {
  switch (take) {
    case TimeReduction::end:
    case TimeReduction::max:
    case TimeReduction::min:
    case TimeReduction::mean: return quantity_unit;
    case TimeReduction::time_of_max:
    case TimeReduction::time_of_min:
    case TimeReduction::onset: return "s";
    case TimeReduction::frequency: return "Hz";
    case TimeReduction::drift:
    case TimeReduction::gain: break;
  }
  return "";
}

const Spec<Expectation>& Expectation::spec() {
  static const auto s =
      Spec<Expectation>()
          .key("quantity", &Expectation::quantity,
               "A probe's field and component (tip.displacement.z, or .magnitude) or a scalar of the whole body "
               "(energy.balance, momentum.angular.z, von_mises.largest).")
          .key("mode", &Expectation::mode,
               "Instead of a quantity: the natural frequency (Hz) of this mode about the rest shape, rigid modes not "
               "counted.",
               {.range = {1, 1000}})
          .key("buckling", &Expectation::buckling,
               "Instead of a quantity, with analysis: buckling: this critical load factor, counted from the lowest.",
               {.range = {1, 1000}})
          .key("take", &Expectation::take, kTakeSentence)
          .key("at", &Expectation::at, "The value at this time, instead of `take`.", {.unit = "s"})
          .key("response", &Expectation::response, kResponseSentence)
          .key("frequency", &Expectation::frequency, kFrequencySentence, {.unit = "Hz", .range = kPositive})
          .key("value", &Expectation::value, "The expected metric, in SI units or with a unit.",
               {.required = true, .unit = kUnitOfQuantity})
          .key("source", &Expectation::source, "Source of the value.", {.required = true})
          .key("relative", &Expectation::relative, "Tolerance relative to the value.", {.range = kPositive})
          .key("absolute", &Expectation::absolute, "Tolerance in the unit of the value.",
               {.unit = kUnitOfQuantity, .range = kPositive})
          .key("of", &Expectation::of, kOfSentence, {.unit = kUnitOfQuantity, .range = kPositive})
          .key("reason", &Expectation::reason, "Reason for the tolerance.", {.required = true})
          .key("degraded", &Expectation::degraded,
               "Multiple of the tolerance up to which `orthodyn stability` rates a deviation as degraded instead of "
               "failed.",
               {.range = {.low = 1}})
          .check(check_expectation);
  return s;
}

ResponseMetric Expectation::response_metric() const { return response.value_or(default_response(frequency)); }

void Expectation::require_units(const std::string& quantity_unit) const {
  require_unit(metric_unit(take, quantity_unit));
  if (of) of->require(quantity_unit, {origin.where + ".of"});
}

void Expectation::require_response_units(const std::string& quantity_unit) const {
  require_unit(metric_unit(response_metric(), quantity_unit));
}

void Expectation::require_unit(const std::string& unit) const {
  value.require(unit, {origin.where + ".value"});
  if (absolute) absolute->require(unit, {origin.where + ".absolute"});
}

double Expectation::limit() const { return relative ? *relative * std::abs(value) : absolute.value_or(0.0).si(); }

std::string Expectation::title() const {
  if (mode) return fmt::format("frequency of mode {}", *mode);
  if (buckling) return fmt::format("critical load factor {}", *buckling);
  if (response || frequency) return response_title(response_metric(), quantity, frequency);
  if (at) return fmt::format("{} at {:.6g} s", quantity, *at);
  return fmt::format("{} of {}", Value<TimeReduction>::yaml(take), quantity);
}

}  // namespace orthodyn
