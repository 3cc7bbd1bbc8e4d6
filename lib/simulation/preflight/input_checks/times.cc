// Times that do not match the run, and a run that does not match the body.

#include <algorithm>
#include <numbers>

#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn::input_checks {

namespace {

constexpr double kShortest = 1e-2;  // duration of the run over the time a wave takes along the body
constexpr double kLongest = 1e9;
constexpr double kMaxPeriods = 1000;          // number of bending periods in the run
constexpr double kLongRun = 10;               // s
constexpr double kEarly = 0.01;               // time since the start over the duration of the run
constexpr double kFewest = 0.01, kMax = 1e6;  // cycles of a sine

// True if the body only vibrates, which does not justify a long run: it does not creep, and loads and supports do not
// change late.
bool only_swings(const CheckContext& context) {
  if (context.built.model->internal_variables()) return false;
  const double omega = context.lowest_bending_frequency();
  if (const auto& damping = context.scene.damping)
    if (damping->mass / omega + damping->stiffness * omega > 2) return false;
  if (!context.built.model->traits().time_dependent) return true;
  const auto ends = context.built.model->breakpoints(context.start(), context.end());
  return !ends.empty() && *std::ranges::max_element(ends) < context.start() + kEarly * context.span();
}

// True if loads act on a viscoelastic body from the start on, so that it vibrates while it creeps, without damping.
bool vibrates_while_it_creeps(const CheckContext& context) {
  const FemModel& model = *context.built.model;
  const auto& loads = model.parts().loads;
  return model.internal_variables() && !model.traits().time_dependent && !context.scene.damping &&
         context.scene.start != Start::equilibrium &&
         std::any_of(loads.begin(), loads.end(), [](const auto& term) { return term->is_load(); });
}

void check_span(const CheckContext& context, Warnings& out) {
  const double crossings = context.span() / context.wave_time();
  const std::string place = context.config.at("time").where();
  if (crossings < kShortest)
    warn(out, place,
         "in {:.3g} s a wave goes through {:.2g} of the body's length: almost nothing moves. Is the end, {:.4g} s, in "
         "another unit, such as ms?",
         context.span(), crossings, context.end());
  if (crossings > kLongest && !context.built.model->internal_variables())
    warn(out, place, "in {:.3g} s a wave goes through the body {:.2g} times: is the end, {:.4g} s, in ms?",
         context.span(), crossings, context.end());
  const double periods = context.span() * context.lowest_bending_frequency() / (2 * std::numbers::pi);
  if (periods > kMaxPeriods && context.has_supports() && vibrates_while_it_creeps(context))
    warn(out, place,
         "the loads act suddenly and start vibrations, about {} periods of {:.2g} s in this run, which relaxation may "
         "hardly damp: let the loads rise over a far longer time (`factor: {{type: smooth_step, end: ...}}`), or give "
         "`damping`",
         factor_text(periods), context.span() / periods);
  const bool is_long = crossings <= kLongest && context.span() > kLongRun && periods > kMaxPeriods;
  if (is_long && context.has_supports() && only_swings(context))
    warn(out, place,
         "in {:.4g} s the body swings about {} times (a period of its lowest vibration is about {:.2g} s): is the end, "
         "{:.4g} s, in ms?",
         context.span(), factor_text(periods), context.span() / periods, context.end());
}

void check_time_functions_end(const CheckContext& context, Warnings& out) {
  visit_time_functions(context, [&](const Config& function) {
    const std::string type = function.at("type").text();
    if (type == "ramp" || type == "smooth_step") {
      const double end = read_number(function.at("end"), {.unit = "s"});
      const double begin = function.has("start") ? read_number(function.at("start"), {.unit = "s"}) : 0;
      if (end > context.end() && begin < context.end())
        warn(out, function.where(),
             "the {} ends at {:.4g} s, after the run, which ends at {:.4g} s: the full value is not reached",
             type == "ramp" ? "ramp" : "step", end, context.end());
    }
    if (type == "sine") {
      const double cycles = read_number(function.at("frequency"), {.unit = "Hz"}) * context.span();
      if (cycles < kFewest || cycles > kMax)
        warn(out, function.where(),
             "the sine makes {:.2g} cycles during the run: is its frequency in Hz, not in kHz, and not per ms?",
             cycles);
    }
  });
}

}  // namespace

void check_time(const CheckContext& context, Warnings& out) {
  if (!context.is_timed_motion()) return;
  check_span(context, out);
  check_time_functions_end(context, out);
  if (const auto interval = context.scene.output.interval; interval && *interval > context.span())
    warn(out, context.config.at("output").at("interval").where(),
         "{:.4g} s is longer than the run of {:.4g} s: there is no frame but the first", *interval, context.span());
  if (const auto& history = context.scene.output.history;
      history && history->interval && *history->interval > context.span())
    warn(out, context.config.at("output").at("history").where(),
         "{:.4g} s is longer than the run of {:.4g} s: the history is its start and its end", *history->interval,
         context.span());
}

}  // namespace orthodyn::input_checks
