#include "lib/scene/expectation.h"

#include <fmt/format.h>

#include <cmath>

namespace orthodyn {

namespace {

void check_expectation(const Expectation& e, const Config& config) {
  if (!e.quantity.empty() + e.mode.has_value() + e.buckling.has_value() != 1)
    config.fail("give exactly one of: quantity, mode, buckling");
  if (e.is_eigenvalue() && (e.take != Take::end || e.at || e.of))
    config.fail("'take', 'at' and 'of' go with a quantity; a mode and a critical load factor have one value");
  if (e.relative.has_value() == e.absolute.has_value()) config.fail("give exactly one of relative, absolute");
  if (e.relative && e.value == 0) config.at("relative").fail("means nothing for the value 0; give 'absolute'");
  check_take(e.take, e.at, e.of, config);
  if (e.source.empty()) config.at("source").fail("is empty; say where the value is known from");
  if (e.reason.empty()) config.at("reason").fail("is empty; say why this tolerance");
}

}  // namespace

void check_take(Take take, const std::optional<double>& at, const std::optional<double>& of, const Config& config) {
  if (at && take != Take::end) config.at("at").fail("replaces 'take'; remove one of them");
  const bool compares = take == Take::drift || take == Take::gain || take == Take::onset;
  if (of && !compares) config.at("of").fail("goes with take: drift, gain or onset only");
  if (!of && take == Take::onset) config.fail("take: onset needs 'of', the size that is passed");
}

std::string metric_unit(Take take, const std::string& quantity_unit) {
  switch (take) {
    case Take::end:
    case Take::max:
    case Take::min:
    case Take::mean: return quantity_unit;
    case Take::time_of_max:
    case Take::time_of_min:
    case Take::onset: return "s";
    case Take::frequency: return "Hz";
    case Take::drift:
    case Take::gain: break;
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
               "Instead of a quantity: the natural frequency in Hz of this mode about the shape at rest, rigid modes "
               "not "
               "counted.",
               {.range = {1, 1000}})
          .key("buckling", &Expectation::buckling,
               "Instead of a quantity, with analysis: buckling: the critical load factor with this number, from the "
               "lowest.",
               {.range = {1, 1000}})
          .key("take", &Expectation::take, kTakeSentence)
          .key("at", &Expectation::at, "The value at this time, instead of `take`.", {.unit = "s"})
          .key("value", &Expectation::value, "The expected metric, in SI units or with a unit.",
               {.required = true, .unit = kUnitOfQuantity})
          .key("source", &Expectation::source, "Where the value is known from.", {.required = true})
          .key("relative", &Expectation::relative, "Tolerance relative to the value.", {.range = kPositive})
          .key("absolute", &Expectation::absolute, "Tolerance in the unit of the value.",
               {.unit = kUnitOfQuantity, .range = kPositive})
          .key("of", &Expectation::of, kOfSentence, {.unit = kUnitOfQuantity, .range = kPositive})
          .key("reason", &Expectation::reason, "Why the tolerance is what it is.", {.required = true})
          .key("degraded", &Expectation::degraded,
               "A multiple of the tolerance: a smaller miss counts as degraded, not failed, in `orthodyn stability`.",
               {.range = {.low = 1}})
          .check(check_expectation);
  return s;
}

void Expectation::require_units(const std::string& quantity_unit) const {
  const std::string unit = metric_unit(take, quantity_unit);
  value.require(unit, {origin.where + ".value"});
  if (absolute) absolute->require(unit, {origin.where + ".absolute"});
  if (of) of->require(quantity_unit, {origin.where + ".of"});
}

double Expectation::limit() const { return relative ? *relative * std::abs(value) : absolute.value_or(0.0).si(); }

std::string Expectation::title() const {
  if (mode) return fmt::format("frequency of mode {}", *mode);
  if (buckling) return fmt::format("critical load factor {}", *buckling);
  if (at) return fmt::format("{} at {:.6g} s", quantity, *at);
  return fmt::format("{} of {}", Value<Take>::yaml(take), quantity);
}

}  // namespace orthodyn
