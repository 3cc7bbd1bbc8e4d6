// Rayleigh damping by which nothing vibrates, though the figure looks as if that were not meant.
#include <fmt/format.h>

#include <numbers>

#include "lib/simulation/preflight/input_checks/subject.h"

namespace orthodyn::input_checks {

namespace {

constexpr double kMostRatio = 50;     // of vibrations along the body; those of bending are slower by its slenderness
constexpr double kMostMassRatio = 8;  // of bending, by damping of the mass
// What people take for damping ratios; a body that is to creep has more.
constexpr double kLeastUsualRatio = 0.004, kMostUsualRatio = 0.25;

void check_stiffness(const Subject& subject, const Config& place, double beta, Warnings& out) {
  const double omega = subject.lowest_along();
  const double ratio = beta * omega / 2;
  const bool looks_like_a_ratio = beta >= kLeastUsualRatio && beta <= kMostUsualRatio;
  if (ratio <= kMostRatio || !(looks_like_a_ratio || beta > subject.span())) return;
  const double bending = Subject::kBending * subject.slenderness();  // of it in omega
  const bool creeps = bending * ratio > 1;
  out.push_back(fmt::format(
      "{}: {:.4g} s gives the lowest vibration along the body ({:.3g} Hz) a damping ratio of {:.3g}, and bending "
      "(about "
      "{:.2g} Hz) about {:.2g}{}{}. Is it meant as a damping ratio? For a ratio xi at the frequency f take xi/(pi f)",
      place.where(), beta, omega / (2 * std::numbers::pi), ratio, bending * omega / (2 * std::numbers::pi),
      bending * ratio, creeps ? ": nothing vibrates, it creeps" : "",
      beta > subject.span() ? fmt::format(", for longer than the run of {:.4g} s", subject.span()) : ""));
}

// Of a body that is held: another one is slowed down as a whole, as by a fluid.
void check_mass(const Subject& subject, const Config& place, double alpha, Warnings& out) {
  const double omega = subject.held() ? subject.lowest_bending() : subject.lowest_along();
  const double ratio = alpha / (2 * omega);
  if (ratio <= (subject.held() ? kMostMassRatio : kMostRatio)) return;
  out.push_back(
      fmt::format("{}: {:.4g} 1/s stops every motion within {:.2g} s: the damping ratio of the lowest "
                  "vibration (about {:.2g} Hz) is about {:.2g}. Is it a damping ratio, or of another unit? "
                  "For a ratio xi at the frequency f take 4 pi f xi",
                  place.where(), alpha, 1 / alpha, omega / (2 * std::numbers::pi), ratio));
}

}  // namespace

void check_damping(const Subject& subject, Warnings& out) {
  if (!subject.moves()) return;
  const auto& damping = subject.scene.damping;
  if (damping) {
    const Config section = subject.config.at("damping");
    if (damping->stiffness > 0) check_stiffness(subject, section.at("stiffness"), damping->stiffness, out);
    if (damping->mass > 0) check_mass(subject, section.at("mass"), damping->mass, out);
  }
  for (const auto& [name, region] : subject.scene.regions)
    if (region.stiffness_damping)
      check_stiffness(subject, subject.config.at("regions").at(name), *region.stiffness_damping, out);
}

}  // namespace orthodyn::input_checks
