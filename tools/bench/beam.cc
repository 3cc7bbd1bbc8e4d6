#include "tools/bench/beam.h"

#include <fmt/format.h>

namespace orthodyn::bench {

namespace {

std::string scene_text(const Beam& beam, int across) {
  const std::string constants = beam.material == "isotropic" ? "young: 2e6" : "young: [2e6, 2e5, 1e5]";
  return fmt::format(R"(
mesh: {{type: box, size: [1, 0.2, 0.2], cells: [{}, {}, {}], order: {}, elements: {}}}
materials: {{soft: {{type: {}, density: 1000, {}, nu: 0.3}}}}
regions: {{body: {{material: soft, formulation: {}, axes: {{first: [0.781639, 0.550117, -0.293958], second: [-0.482929, 0.832030, 0.272956]}}}}}}
{}
gravity: [0, 0, -4]
clamps: [{{surface: x0}}]
time: {{end: 1}}
integrator: {{type: cvode_bdf}}
)",
                     5 * across, across, across, beam.order, beam.elements, beam.material, constants, beam.formulation,
                     beam.damped ? "damping: {stiffness: 0.01}" : "");
}

// Bends the axis to a circular arc of half a radian and twists the beam by half a radian.
Vec3 displacement(const Vec3& X) {
  constexpr double kCurvature = 0.5, kTwist = 0.5;  // 1/m
  const Vec3 c(0, X[1] - 0.1, X[2] - 0.1);
  const double a = kTwist * X[0], b = kCurvature * X[0];
  const Vec3 turned(0, std::cos(a) * c[1] - std::sin(a) * c[2], std::sin(a) * c[1] + std::cos(a) * c[2]);
  const Vec3 axis(std::sin(b) / kCurvature, 0, (std::cos(b) - 1) / kCurvature);
  return axis + Vec3(std::sin(b) * turned[2], turned[1], std::cos(b) * turned[2]) - Vec3(X[0], c[1], c[2]);
}

}  // namespace

BentBeam::BentBeam(const Beam& beam, int across)
    : built_(build(read_scene(Config::from_text(scene_text(beam, across))))), elements_(0) {
  const auto& parts = built_.model->parts();
  for (const auto& term : parts.elastic) elements_ += term->size();
  NodalVector u(3, parts.rest->cols());
  for (Eigen::Index i = 0; i < u.cols(); ++i) u.col(i) = displacement(parts.rest->col(i));
  q_.resize(built_.model->num_dofs());
  parts.dofs->restrict_to(u, q_);
  v_ = 10 * q_;
}

}  // namespace orthodyn::bench
