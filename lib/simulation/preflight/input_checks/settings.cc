// Tolerances, scales and steps of the integrator outside any useful range.

#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn::input_checks {

namespace {

constexpr double kCoarsest = 0.1, kFinest = 1e-13;            // of rtol
constexpr double kLargestScale = 30, kSmallestScale = 1e-12;  // over the body's length or wave speed
constexpr double kMaxSteps = 1e9;
constexpr double kLargestLeast = 0.1;  // smallest step over the duration of the run

void check_tolerance(const CheckContext& context, const char* section, Warnings& out) {
  const auto rtol = find_value(context.config, {section, "rtol"});
  if (!rtol || !rtol->reads_as_number()) return;
  if (rtol->number() > kCoarsest)
    warn(out, rtol->where(),
         "{:.3g} permits an error of {:.0f} % of the motion in each step: the result is meaningless. 1e-2 is coarse, "
         "1e-4 usual",
         rtol->number(), 100 * rtol->number());
  if (rtol->number() < kFinest)
    warn(out, rtol->where(),
         "{:.3g} is below round-off (about 1e-13): steps become extremely short, or none is accepted. 1e-8 is fine "
         "already",
         rtol->number());
}

// Checks an error scale (length or speed). `natural`: length or wave speed of the body.
void check_scale(const CheckContext& context, const char* key, const char* unit, double natural, Warnings& out) {
  const auto scale = find_value(context.config, {"integrator", key});
  if (!scale || scale->text() == "auto") return;
  const double share = read_number(*scale, {.unit = unit}) / natural;
  if (share > kLargestScale)
    warn(out, scale->where(), "{} is {} times the scale of the body ({:.3g} {}): errors are not detected. Is it in mm?",
         scale->text(), factor_text(share), natural, unit);
  if (share < kSmallestScale)
    warn(out, scale->where(), "{} is {:.1g} of the scale of the body ({:.3g} {}): round-off is mistaken for errors",
         scale->text(), share, natural, unit);
}

void check_step(const CheckContext& context, Warnings& out) {
  for (const char* key : {"step", "h_max", "h_min", "h0"}) {
    const auto value = find_value(context.config, {"integrator", key});
    if (!value || value->text() == "auto") continue;
    const double step = read_number(*value, {.unit = "s"});
    const bool shortens = std::string(key) == "step" || std::string(key) == "h_max";
    if (step > context.span() && std::string(key) != "h_max")
      warn(out, value->where(), "{:.4g} s is longer than the run of {:.4g} s: is it in ms?", step, context.span());
    if (std::string(key) == "h_min" && step > kLargestLeast * context.span() && step <= context.span())
      warn(out, value->where(),
           "steps of at least {:.4g} s in a run of {:.4g} s cannot be adapted to errors: is it in ms?", step,
           context.span());
    if (shortens && step * kMaxSteps < context.span())
      warn(out, value->where(), "the run of {:.4g} s needs {:.1g} such steps: is the step in another unit?",
           context.span(), context.span() / step);
  }
}

void check_corrector(const CheckContext& context, Warnings& out) {
  const auto corrector = find_value(context.config, {"integrator", "sensitivity_corrector"});
  if (corrector && corrector->text() == "simultaneous" && context.scene.sensitivities.empty())
    warn(out, corrector->where(), "has no effect without `sensitivities`: remove it, or list parameters there");
}

}  // namespace

void check_setting(const CheckContext& context, Warnings& out) {
  if (!context.is_timed_motion()) return;
  check_tolerance(context, "integrator", out);
  check_scale(context, "position_scale", "m", context.extent, out);
  check_scale(context, "velocity_scale", "m/s", context.wave_speed, out);
  check_step(context, out);
  check_corrector(context, out);
}

}  // namespace orthodyn::input_checks
