// Initial and prescribed motions that are too fast or too far for the body.
#include <fmt/format.h>

#include <algorithm>

#include "lib/simulation/preflight/input_checks/subject.h"

namespace orthodyn::input_checks {

namespace {

constexpr double kFastestBody = 3000;  // m/s; faster than a bullet
constexpr double kFarthest = 100;      // lengths of the body, of a support

void check_velocity(const Subject& subject, Warnings& out) {
  const State& start = subject.built.initial;
  if (start.v.isZero(0) || !subject.config.has("initial")) return;
  const auto& parts = subject.built.model->parts();
  NodalVector v = NodalVector::Zero(3, parts.rest->cols());
  parts.dofs->add_to(start.v, v);
  const double fastest = v.colwise().norm().maxCoeff();
  if (!subject.held()) v.colwise() -= v.rowwise().mean();
  const double relative = v.colwise().norm().maxCoeff();
  const std::string place = subject.config.at("initial").where();
  if (fastest > kFastestBody)
    out.push_back(
        fmt::format("{}: nodes start with {:.4g} m/s, faster than a bullet: is the velocity in m/s, the spin "
                    "in rad/s?",
                    place, fastest));
  else if (relative > subject.wave)
    out.push_back(
        fmt::format("{}: parts of the body start with {:.4g} m/s against each other or their supports, faster "
                    "than the waves in it ({:.3g} m/s): it will be crushed or torn. Are velocity and spin in "
                    "m/s and rad/s, the moduli in Pa?",
                    place, relative, subject.wave));
}

void check_support(const Subject& subject, Warnings& out) {
  const auto& parts = subject.built.model->parts();
  if (!parts.moved) return;
  double farthest = 0, fastest = 0;
  visit_times(subject, [&](double t) {
    NodalVector u = NodalVector::Zero(3, parts.rest->cols()), v = u;
    parts.moved->place(t, u, v);
    farthest = std::max(farthest, u.colwise().norm().maxCoeff());
    fastest = std::max(fastest, v.colwise().norm().maxCoeff());
  });
  const std::string place = subject.config.at("motions").where();
  if (farthest > kFarthest * subject.extent)
    out.push_back(fmt::format("{}: nodes are moved by {:.4g} m, {:.0f} times the length of the body: is that in mm?",
                              place, farthest, farthest / subject.extent));
  else if (subject.moves() && fastest > subject.wave)
    out.push_back(
        fmt::format("{}: nodes are moved at {:.4g} m/s, faster than the waves in the body ({:.3g} m/s): is "
                    "the time in ms, the distance in mm?",
                    place, fastest, subject.wave));
}

}  // namespace

void check_motion(const Subject& subject, Warnings& out) {
  if (!subject.is_static()) check_velocity(subject, out);
  if (subject.is_static() || subject.is_timed) check_support(subject, out);
  if (const auto& initial = subject.scene.initial; initial && initial->noise)
    if (initial->noise->amplitude > subject.extent)
      out.push_back(fmt::format("{}: {:.4g} m is more than the length of the body, {:.4g} m: is that in mm?",
                                subject.config.at("initial").at("noise").where(), initial->noise->amplitude,
                                subject.extent));
}

}  // namespace orthodyn::input_checks
