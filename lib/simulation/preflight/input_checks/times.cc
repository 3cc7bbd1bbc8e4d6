// Times that do not go with the run, and a run that does not go with the body.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "lib/simulation/preflight/input_checks/subject.h"

namespace orthodyn::input_checks {

namespace {

constexpr double kShortest = 1e-2;  // of the time that a wave takes along the body
constexpr double kLongest = 1e9;
constexpr double kMostPeriods = 1000;          // of bending
constexpr double kLongRun = 10;                // s
constexpr double kEarly = 0.01;                // of the run
constexpr double kFewest = 0.01, kMost = 1e6;  // cycles of a sine

// A body that creeps, or whose loads and supports change late, has a reason for a long run.
bool only_swings(const Subject& subject) {
  const double omega = subject.lowest_bending();
  if (const auto& damping = subject.scene.damping)
    if (damping->mass / omega + damping->stiffness * omega > 2) return false;
  if (!subject.built.model->traits().time_dependent) return true;
  const auto ends = subject.built.model->breakpoints(subject.start(), subject.end());
  return !ends.empty() && *std::ranges::max_element(ends) < subject.start() + kEarly * subject.span();
}

void check_span(const Subject& subject, Warnings& out) {
  const double crossings = subject.span() / subject.crossing();
  const std::string place = subject.config.at("time").where();
  if (crossings < kShortest)
    out.push_back(
        fmt::format("{}: in {:.3g} s a wave goes through {:.2g} of the body's length: almost nothing "
                    "moves. Is the end, {:.4g} s, in another unit, such as ms?",
                    place, subject.span(), crossings, subject.end()));
  if (crossings > kLongest)
    out.push_back(fmt::format("{}: in {:.3g} s a wave goes through the body {:.2g} times: is the end, {:.4g} s, in ms?",
                              place, subject.span(), crossings, subject.end()));
  const double periods = subject.span() * subject.lowest_bending() / (2 * std::numbers::pi);
  const bool is_long = crossings <= kLongest && subject.span() > kLongRun && periods > kMostPeriods;
  if (is_long && subject.held() && only_swings(subject))
    out.push_back(
        fmt::format("{}: in {:.4g} s the body swings about {} times (a period of its lowest vibration is "
                    "about {:.2g} s): is the end, {:.4g} s, in ms?",
                    place, subject.span(), shown_factor(periods), subject.span() / periods, subject.end()));
}

void add_factor_times(const Subject& subject, const Config& section, Warnings& out) {
  visit_keys(section, "factor", [&](const Config& given) {
    if (!names_a_factor(given)) return;
    const std::string type = given.at("type").text();
    if (type == "ramp" || type == "smooth_step") {
      const double end = read_number(given.at("end"), {.unit = "s"});
      const double begin = given.has("start") ? read_number(given.at("start"), {.unit = "s"}) : 0;
      if (end > subject.end() && begin < subject.end())
        out.push_back(
            fmt::format("{}: the {} ends at {:.4g} s, after the run, which ends at {:.4g} s: the full value "
                        "is not reached",
                        given.where(), type == "ramp" ? "ramp" : "step", end, subject.end()));
    }
    if (type == "sine") {
      const double cycles = read_number(given.at("frequency"), {.unit = "Hz"}) * subject.span();
      if (cycles < kFewest || cycles > kMost)
        out.push_back(
            fmt::format("{}: the sine makes {:.2g} cycles during the run: is its frequency in Hz, not in "
                        "kHz, and not per ms?",
                        given.where(), cycles));
    }
  });
}

}  // namespace

void check_time(const Subject& subject, Warnings& out) {
  if (!subject.moves()) return;
  check_span(subject, out);
  for (const char* section : {"loads", "terms", "motions"})
    if (subject.config.has(section)) add_factor_times(subject, subject.config.at(section), out);
  if (const auto interval = subject.scene.output.interval; interval && *interval > subject.span())
    out.push_back(fmt::format("{}: {:.4g} s is longer than the run of {:.4g} s: there is no frame but the first",
                              subject.config.at("output").at("interval").where(), *interval, subject.span()));
  if (const auto& history = subject.scene.output.history;
      history && history->interval && *history->interval > subject.span())
    out.push_back(fmt::format("{}: {:.4g} s is longer than the run of {:.4g} s: the history is its start and its end",
                              subject.config.at("output").at("history").where(), *history->interval, subject.span()));
}

}  // namespace orthodyn::input_checks
