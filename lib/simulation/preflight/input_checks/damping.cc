// Rayleigh damping that suppresses all vibrations, probably unintentionally.

#include <numbers>

#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn::input_checks {

namespace {

constexpr double kMaxRatio = 50;     // damping ratio of axial vibrations; that of bending is smaller by the slenderness
constexpr double kMaxMassRatio = 8;  // damping ratio of bending by mass-proportional damping
// Range of stiffness-damping values that look like damping ratios.
constexpr double kLeastUsualRatio = 0.004, kMaxUsualRatio = 0.25;

void check_stiffness(const CheckContext& context, const Config& place, double beta, Warnings& out) {
  const double omega = context.lowest_axial_frequency();
  const double ratio = beta * omega / 2;
  const bool looks_like_a_ratio = beta >= kLeastUsualRatio && beta <= kMaxUsualRatio;
  if (ratio <= kMaxRatio || !(looks_like_a_ratio || beta > context.span())) return;
  const double bending =
      CheckContext::kBendingOverAxial * context.slenderness();  // lowest bending frequency over omega
  const bool creeps = bending * ratio > 1;
  warn(out, place.where(),
       "{:.4g} s gives the lowest axial vibration ({:.3g} Hz) a damping ratio of {:.3g}, and bending (about {:.2g} Hz) "
       "about {:.2g}{}{}. Is it a damping ratio? For a ratio xi at the frequency f use xi/(pi f)",
       beta, omega / (2 * std::numbers::pi), ratio, bending * omega / (2 * std::numbers::pi), bending * ratio,
       creeps ? ": the body creeps back without vibrating" : "",
       beta > context.span() ? fmt::format(", for longer than the run of {:.4g} s", context.span()) : "");
}

// Judges a body with supports by its bending vibration. A free body, which is slowed down as a whole, as in a fluid, is
// judged by its axial vibration.
void check_mass(const CheckContext& context, const Config& place, double alpha, Warnings& out) {
  const double omega = context.has_supports() ? context.lowest_bending_frequency() : context.lowest_axial_frequency();
  const double ratio = alpha / (2 * omega);
  if (ratio <= (context.has_supports() ? kMaxMassRatio : kMaxRatio)) return;
  warn(out, place.where(),
       "{:.4g} 1/s stops every motion within {:.2g} s: the damping ratio of the lowest vibration (about {:.2g} Hz) is "
       "about {:.2g}. Is it a damping ratio, or in another unit? For a ratio xi at the frequency f use 4 pi f xi",
       alpha, 1 / alpha, omega / (2 * std::numbers::pi), ratio);
}

}  // namespace

void check_damping(const CheckContext& context, Warnings& out) {
  if (!context.is_timed_motion()) return;
  const auto& damping = context.scene.damping;
  if (damping) {
    const Config section = context.config.at("damping");
    if (damping->stiffness > 0) check_stiffness(context, section.at("stiffness"), damping->stiffness, out);
    if (damping->mass > 0) check_mass(context, section.at("mass"), damping->mass, out);
  }
  for (const auto& [name, region] : context.scene.regions)
    if (region.stiffness_damping)
      check_stiffness(context, context.config.at("regions").at(name), *region.stiffness_damping, out);
}

}  // namespace orthodyn::input_checks
