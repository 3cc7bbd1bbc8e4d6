// Initial and prescribed motions that are too fast or too large for the body.

#include <algorithm>

#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn::input_checks {

namespace {

constexpr double kFastestBody = 3000;  // m/s; faster than a bullet
constexpr double kFarthest = 100;      // displacement of a support over the length of the body

void check_velocity(const CheckContext& context, Warnings& out) {
  const State& start = context.built.initial;
  if (start.v.isZero(0) || !context.config.has("initial")) return;
  const auto& parts = context.built.model->parts();
  NodalVector v = NodalVector::Zero(3, parts.rest->cols());
  parts.dofs->add_to(start.v, v);
  const double fastest = v.colwise().norm().maxCoeff();
  if (!context.has_supports()) v.colwise() -= v.rowwise().mean();
  const double relative = v.colwise().norm().maxCoeff();
  const std::string place = context.config.at("initial").where();
  if (fastest > kFastestBody)
    warn(out, place, "nodes start with {:.4g} m/s, faster than a bullet: is the velocity in m/s, the spin in rad/s?",
         fastest);
  else if (relative > context.wave_speed)
    warn(out, place,
         "parts of the body start with {:.4g} m/s relative to each other or to their supports, faster than the waves "
         "in it ({:.3g} m/s): it will be crushed or torn. Are velocity and spin in m/s and rad/s, the moduli in Pa?",
         relative, context.wave_speed);
}

void check_support(const CheckContext& context, Warnings& out) {
  const auto& parts = context.built.model->parts();
  if (!parts.moved) return;
  double farthest = 0, fastest = 0;
  visit_times(context, [&](double t) {
    NodalVector u = NodalVector::Zero(3, parts.rest->cols()), v = u;
    parts.moved->place(t, u, v);
    farthest = std::max(farthest, u.colwise().norm().maxCoeff());
    fastest = std::max(fastest, v.colwise().norm().maxCoeff());
  });
  const std::string place = context.config.at("motions").where();
  if (farthest > kFarthest * context.extent)
    warn(out, place, "nodes are moved by {:.4g} m, {:.0f} times the length of the body: is it in mm?", farthest,
         farthest / context.extent);
  else if (context.is_timed_motion() && fastest > context.wave_speed)
    warn(out, place,
         "nodes are moved at {:.4g} m/s, faster than the waves in the body ({:.3g} m/s): is the time in ms, the "
         "distance in mm?",
         fastest, context.wave_speed);
}

}  // namespace

void check_motion(const CheckContext& context, Warnings& out) {
  if (!context.is_static()) check_velocity(context, out);
  if (context.is_static() || context.is_timed) check_support(context, out);
  if (const auto& initial = context.scene.initial; initial && initial->noise)
    if (initial->noise->amplitude > context.extent)
      warn(out, context.config.at("initial").at("noise").where(),
           "{:.4g} m is more than the length of the body, {:.4g} m: is it in mm?", initial->noise->amplitude,
           context.extent);
}

}  // namespace orthodyn::input_checks
