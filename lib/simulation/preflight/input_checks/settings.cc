// Tolerances, scales and steps of the integrator that cannot serve.
#include <fmt/format.h>

#include "lib/simulation/preflight/input_checks/subject.h"

namespace orthodyn::input_checks {

namespace {

constexpr double kCoarsest = 0.1, kFinest = 1e-13;            // of rtol
constexpr double kLargestScale = 30, kSmallestScale = 1e-12;  // of the body's length, of the waves in it
constexpr double kMostSteps = 1e9;
constexpr double kLargestLeast = 0.1;  // step, of the run

void check_tolerance(const Subject& subject, const char* section, Warnings& out) {
  const auto rtol = value_at(subject.config, {section, "rtol"});
  if (!rtol || !rtol->reads_as_number()) return;
  if (rtol->number() > kCoarsest)
    out.push_back(
        fmt::format("{}: {:.3g} lets each step be off by {:.0f} % of the motion: the result means nothing. "
                    "1e-2 is coarse, 1e-4 usual",
                    rtol->where(), rtol->number(), 100 * rtol->number()));
  if (rtol->number() < kFinest)
    out.push_back(
        fmt::format("{}: {:.3g} is below what round-off allows (about 1e-13): steps become as short as can "
                    "be, or none is accepted. 1e-8 is fine already",
                    rtol->where(), rtol->number()));
}

// A length or a speed that errors are compared with, and how large it may be.
void check_scale(const Subject& subject, const char* key, const char* unit, double natural, Warnings& out) {
  const auto scale = value_at(subject.config, {"integrator", key});
  if (!scale || scale->text() == "auto") return;
  const double share = read_number(*scale, {.unit = unit}) / natural;
  if (share > kLargestScale)
    out.push_back(
        fmt::format("{}: {} is {} times what the body allows ({:.3g} {}): errors are not seen. Is it in "
                    "mm?",
                    scale->where(), scale->text(), shown_factor(share), natural, unit));
  if (share < kSmallestScale)
    out.push_back(fmt::format("{}: {} is {:.1g} of what the body allows ({:.3g} {}): round-off is taken for errors",
                              scale->where(), scale->text(), share, natural, unit));
}

void check_step(const Subject& subject, Warnings& out) {
  for (const char* key : {"step", "h_max", "h_min", "h0"}) {
    const auto value = value_at(subject.config, {"integrator", key});
    if (!value || value->text() == "auto") continue;
    const double step = read_number(*value, {.unit = "s"});
    const bool shortens = std::string(key) == "step" || std::string(key) == "h_max";
    if (step > subject.span() && std::string(key) != "h_max")
      out.push_back(fmt::format("{}: {:.4g} s is longer than the run of {:.4g} s: is it in ms?", value->where(), step,
                                subject.span()));
    if (std::string(key) == "h_min" && step > kLargestLeast * subject.span() && step <= subject.span())
      out.push_back(
          fmt::format("{}: steps of at least {:.4g} s in a run of {:.4g} s cannot follow an error: is it in "
                      "ms?",
                      value->where(), step, subject.span()));
    if (shortens && step * kMostSteps < subject.span())
      out.push_back(fmt::format("{}: the run of {:.4g} s needs {:.1g} such steps: is the step in another unit?",
                                value->where(), subject.span(), subject.span() / step));
  }
}

}  // namespace

void check_setting(const Subject& subject, Warnings& out) {
  if (!subject.moves()) return;
  check_tolerance(subject, "integrator", out);
  check_scale(subject, "position_scale", "m", subject.extent, out);
  check_scale(subject, "velocity_scale", "m/s", subject.wave, out);
  check_step(subject, out);
}

}  // namespace orthodyn::input_checks
