#include "lib/fem/motion/support_motion.h"

namespace orthodyn {

const Spec<Rotation>& Rotation::spec() {
  static const auto s =
      Spec<Rotation>()
          .key("point", &Rotation::point, "A point on the axis, at rest; a translation moves it as well.",
               {.unit = "m"})
          .key("axis", &Rotation::axis, "Direction of the rotation axis, of any length.", {.required = true})
          .key("angle", &Rotation::angle, "Angle at factor 1, by the right-hand rule; more than a turn is possible.",
               {.required = true, .unit = "rad"})
          .check([](const Rotation& r, const Config& config) {
            if (r.axis.norm() == 0) config.at("axis").fail("is zero; give a direction");
          });
  return s;
}

namespace {

// Refuses a translation along free components only, which would have no effect.
void check_translation(const SupportMotion& m, const Config& config) {
  if (!m.translation || m.translation->isZero(0)) return;
  for (const Component c : m.components)
    if ((*m.translation)[static_cast<int>(c)] != 0) return;
  config.at("translation")
      .fail("moves nothing: it is zero along the chosen components; add the components that it moves to 'components'");
}

void check_motion(const SupportMotion& m, const Config& config) {
  m.check(config);
  if (m.components.empty()) config.at("components").fail("is empty; give some of x, y, z");
  const bool rigid = m.translation || m.rotation;
  if (rigid == m.displacement.has_value())
    config.fail("give either translation and rotation (one or both), or three formulas as displacement");
  if (rigid && !m.factor)
    config.fail("key 'factor' is missing: give the time function, such as factor: {type: smooth_step, end: 1}");
  if (!rigid && m.factor)
    config.at("factor").fail("is used with translation and rotation only; use t in the displacement formulas");
  if (rigid && !m.kinks.empty())
    config.at("kinks").fail("is used with displacement only; the factor has its own kinks");
  if (rigid && m.resolution) config.at("resolution").fail("is used with displacement only; the factor has exact rates");
  check_translation(m, config);
}

}  // namespace

const Spec<SupportMotion>& SupportMotion::spec() {
  static const auto s =
      selection_spec<SupportMotion>()
          .key("name", &SupportMotion::name, "Name of its reaction; default motion_1, motion_2 and so on.")
          .key("components", &SupportMotion::components, "Which coordinates are moved; the others stay free.")
          .key("translation", &SupportMotion::translation, "Translation at factor 1.", {.unit = "m"})
          .key("rotation", &SupportMotion::rotation, "Rotation about an axis.")
          .key("factor", &SupportMotion::factor, "Time function that multiplies translation and angle.")
          .key("displacement", &SupportMotion::displacement,
               "Displacement from the rest position, in m: three formulas of the time t and the rest position x, y, z.")
          .key("kinks", &SupportMotion::kinks, "Times where the formulas are not smooth; integrators restart there.",
               {.unit = "s"})
          .key("resolution", &SupportMotion::resolution,
               "Step of the finite differences for velocity and acceleration: at most 1/60 of the shortest period of "
               "the formulas; default: chosen from the formulas' course over the time span.",
               {.unit = "s", .range = kPositive})
          .check(check_motion);
  return s;
}

void SupportMotion::declare(Traits& traits) const {
  traits.loaded = traits.time_dependent = true;
  traits.conservative = false;
}

std::shared_ptr<const Motion> SupportMotion::motion(double start, double end, const NodalVector& X) const {
  if (displacement) {
    DifferenceStep step = resolution ? DifferenceStep(*resolution)
                                     : DifferenceStep(step_limits_of(*displacement, start, end, kinks, X), start, end);
    return formula_motion(*displacement, std::move(step), kinks, start);
  }
  const Rotation turn = rotation.value_or(Rotation{});
  const auto resolved = factor->over(start, end);
  return rigid_motion(translation.value_or(Vec3::Zero()), turn.point, turn.axis.normalized(), turn.angle,
                      resolved ? resolved : factor);
}

}  // namespace orthodyn
