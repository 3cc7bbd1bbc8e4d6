#include "lib/scene/joint_input.h"

#include <fmt/format.h>

#include <cmath>

#include "lib/fem/terms/dead_load.h"
#include "lib/scene/output_files.h"

namespace orthodyn {

const Spec<JointEnd>& JointEnd::spec() {
  static const auto s =
      selection_spec<JointEnd>().check([](const JointEnd& end, const Config& config) { end.check(config); });
  return s;
}

const Spec<JointSpring>& JointSpring::spec() {
  static const auto s =
      Spec<JointSpring>()
          .key("stiffness", &JointSpring::stiffness, "Force per distance (N/m), or torque per angle (N m).",
               {.range = kNonNegative})
          .key("damping", &JointSpring::damping, "Force per velocity (N s/m), or torque per angular velocity (N m s).",
               {.range = kNonNegative})
          .key("rest", &JointSpring::rest,
               "Coordinate without force, such as 30 deg; default 0, the rest shape. Of a strut: the change of its "
               "length, not its length.")
          .check([](const JointSpring& spring, const Config& config) {
            if (spring.stiffness == 0 && spring.damping == 0) config.fail("give a stiffness, a damping, or both");
            if (spring.stiffness == 0 && spring.rest != 0)
              config.at("rest").fail("has no effect without a stiffness; remove it");
          });
  return s;
}

const Spec<JointStop>& JointStop::spec() {
  static const auto s =
      Spec<JointStop>()
          .key("low", &JointStop::low, "Lowest coordinate, 0 in the rest shape; default: none.")
          .key("high", &JointStop::high, "Highest coordinate; default: none.")
          .key("stiffness", &JointStop::stiffness, "Of the stop: N/m, or N m per rad.",
               {.required = true, .range = kPositive})
          .key("onset", &JointStop::onset,
               "Distance or angle over which the stop sets in; default a hundredth of the range, or of a line's length "
               "or a radian.",
               {.range = kPositive})
          .check([](const JointStop& stop, const Config& config) {
            if (!stop.low && !stop.high) config.fail("give `low`, `high` or both");
            if (stop.low && stop.high && *stop.low >= *stop.high) config.at("high").fail("must be above `low`");
            for (const char* key : {"low", "high"}) {
              const auto& limit = key[0] == 'l' ? stop.low : stop.high;
              if (limit && (key[0] == 'l' ? *limit > 0 : *limit < 0))
                config.at(key).fail("excludes the rest shape, where the coordinate is 0");
            }
          });
  return s;
}

const Spec<JointFriction>& JointFriction::spec() {
  static const auto s =
      Spec<JointFriction>()
          .key("limit", &JointFriction::limit, "Largest friction force (N) or torque (N m).",
               {.required = true, .range = kPositive})
          .key("creep", &JointFriction::creep,
               "Rate at which friction reaches 0.7 of its limit, m/s or rad/s; default 1 mm/s, or 0.01 rad/s.",
               {.range = kPositive});
  return s;
}

const Spec<JointLoading>& JointLoading::spec() {
  static const auto s =
      Spec<JointLoading>()
          .key("amount", &JointLoading::amount,
               "Force along the line (N), or torque about it (N m), on the first body at factor 1.", {.required = true})
          .key("factor", &JointLoading::factor, "Factor in time.", {.fallback = "{type: constant}"});
  return s;
}

const Spec<JointDrive>& JointDrive::spec() {
  static const auto s =
      Spec<JointDrive>()
          .key("to", &JointDrive::to, "Coordinate at factor 1, such as 90 deg; of a distance, its change.",
               {.required = true})
          .key("factor", &JointDrive::factor, "Time function that multiplies `to`; 0 at the start.", {.required = true})
          .check([](const JointDrive& drive, const Config& config) {
            if (!drive.factor->has_continuous_rate())
              config.at("factor").fail(
                  "its rate may jump, which needs an infinite force; use a smooth_step, or a formula without kinks");
          });
  return s;
}

namespace {

void refuse_keys_of_other_types(const JointInput& joint, const Config& config) {
  for (const char* key : {"spring", "stop", "friction", "load"})
    if (config.has(key) && !joint.may_have_forces())
      config.at(key).fail(
          joint.type == JointType::distance
              ? "has no effect on a distance that the joint holds; use type: strut, which leaves it free"
              : "is for joints of type hinge, slot, cylindrical, slider and strut");
  if (config.has("motor") && !joint.may_have_motor())
    config.at("motor").fail(joint.type == JointType::strut
                                ? "prescribes the distance, which a strut leaves free; use type: distance"
                                : "is for joints of type hinge, slot, cylindrical, slider and distance");
  if (config.has("along") && joint.type != JointType::cylindrical)
    config.at("along").fail("is for joints of type cylindrical, which slide and turn; remove it");
  if (joint.type == JointType::strut && !(joint.spring || joint.stop || joint.friction || joint.load))
    config.fail("a strut holds nothing: give a spring, stop, friction or load; a massless rod is type: distance");
}

// Refuses values of a changed distance that no two points have.
void check_distances(const JointInput& joint, const Config& config) {
  if (joint.type != JointType::strut) return;
  const double length = (*joint.to - *joint.from).norm();
  const auto require_above = [&](const char* section, const char* key, double change) {
    if (change <= -length)
      config.at(section).at(key).fail(
          fmt::format("must be above {:.4g} m: it is the change of the distance of `from` and `to`, {:.4g} m at rest",
                      -length, length));
  };
  if (joint.spring) require_above("spring", "rest", joint.spring->rest);
  if (joint.stop && joint.stop->low) require_above("stop", "low", *joint.stop->low);
}

void check_drive(const JointInput& joint, const Config& config) {
  const std::string unit = joint.turns() ? "rad" : "m";
  refuse_keys_of_other_types(joint, config);
  const auto require = [&](const char* section, const char* key, const QuantityValue& value) {
    if (config.at(section).has(key)) value.require(unit, {config.at(section).at(key).where()});
  };
  if (joint.load) joint.load->amount.require(joint.turns() ? "N m" : "N", {config.at("load").at("amount").where()});
  if (joint.spring) require("spring", "rest", joint.spring->rest);
  if (joint.turns()) {
    constexpr double kHalfTurn = 3.14159265358979;
    const auto require_half_turn = [&](const char* section, const char* key, double angle) {
      if (std::abs(angle) >= kHalfTurn)
        config.at(section).at(key).fail(
            fmt::format("springs and stops see angles between -180 and 180 deg, found {:.4g} rad; give degrees as "
                        "'90 deg'",
                        angle));
    };
    if (joint.spring) require_half_turn("spring", "rest", joint.spring->rest);
    if (joint.stop && joint.stop->low) require_half_turn("stop", "low", *joint.stop->low);
    if (joint.stop && joint.stop->high) require_half_turn("stop", "high", *joint.stop->high);
  }
  if (joint.stop) {
    require("stop", "low", joint.stop->low.value_or(0));
    require("stop", "high", joint.stop->high.value_or(0));
    require("stop", "onset", joint.stop->onset.value_or(0));
  }
  if (!joint.motor) return;
  require("motor", "to", joint.motor->to);
  if (joint.stop || (joint.spring && joint.spring->stiffness > 0))
    config.at("motor").fail("prescribes the coordinate: remove the spring and the stop");
}

void check_joint(const JointInput& joint, const Config& config) {
  require_name_for_csv(joint.name, {config.at("name").where()});
  check_drive(joint, config);
  const bool at_point = joint.is_at_a_point();
  if (at_point && !joint.at) config.fail("a ball or fixed joint needs `at`, a point of both bodies");
  if (at_point && (joint.from || joint.to)) config.fail("a ball or fixed joint has no `from` and `to`; give `at`");
  if (!at_point && joint.at) config.at("at").fail("is for ball and fixed joints; give `from` and `to`");
  if (!at_point && (!joint.from || !joint.to))
    config.fail(joint.type == JointType::hinge ? "a hinge needs `from` and `to`, the ends of its pin"
                : joint.stretches()
                    ? "a distance or strut needs `from`, on the first body, and `to`, on the second"
                    : "needs `from` and `to`, two points of the line along which the first body slides");
  if (!at_point && (*joint.from - *joint.to).norm() == 0) config.at("to").fail("is the same point as `from`");
  check_distances(joint, config);
}

}  // namespace

const Spec<JointInput>& JointInput::spec() {
  using J = JointInput;
  static const auto s =
      Spec<J>()
          .key("type", &J::type,
               "ball: a point of both bodies; fixed: a point, and the bodies do not turn against each other; hinge: "
               "two points, the ends of a pin; distance: a massless rod; slot: the "
               "point `from` of the first body stays on the line of the second one through `from` and `to`; "
               "cylindrical: "
               "both points of the first body stay on this line; slider: they do, and the bodies do not turn about it; "
               "strut: holds nothing, forces act along the line from `from` on the first body to `to` on the second.",
               {.required = true})
          .key("name", &J::name, "Name of the outputs, such as joint.NAME.", {.required = true})
          .key("at", &J::at, "The point of a ball or fixed joint.", {.unit = "m"})
          .key("from", &J::from,
               "First end of the pin of a hinge, of the rod or strut, on the first body, or of the line of a slot or "
               "slider.",
               {.unit = "m"})
          .key("to", &J::to,
               "Second end of the pin of a hinge, of the rod or strut, on the second body, or of the line.",
               {.unit = "m"})
          .key("first", &J::first, "Nodes of the first body that hold the joint.", {.required = true})
          .key("second", &J::second, "Nodes of the second body that hold the joint; default: a point fixed in space.")
          .key("along", &J::along,
               "Of a cylindrical joint: whether forces and motors act along the line (slide) or about it (turn); "
               "default slide.")
          .key(
              "spring", &J::spring,
              "Spring and damping along the coordinate of the joint: the distance of the first body along the line, or "
              "its angle about it by the right-hand rule, from the rest shape; of a strut, the change of the distance "
              "of its points.")
          .key("stop", &J::stop, "Limits of the coordinate.")
          .key("friction", &J::friction, "Friction against changes of the coordinate.")
          .key("load", &J::load, "Force or torque along the coordinate, on the first body.")
          .key("motor", &J::motor, "The coordinate is prescribed in time.")
          .check(check_joint);
  return s;
}

JointLaw JointInput::law() const {
  JointLaw out;
  if (spring) out.spring = {spring->stiffness, spring->damping, spring->rest};
  if (stop) {
    const double range = stop->low && stop->high ? *stop->high - *stop->low : turns() ? 1 : (*to - *from).norm();
    out.stop = {stop->low, stop->high, stop->stiffness, stop->onset.value_or(0.01 * range)};
  }
  if (friction) out.friction = {friction->limit, friction->creep.value_or(turns() ? 0.01 : 1e-3)};
  return out;
}

void JointInput::declare(Traits& traits) const {
  if (motor) traits.loaded = traits.time_dependent = true;
  if (motor) traits.conservative = false;
  if (load) {
    declare_load(*load->factor, traits);
    traits.linear = false;
  }
  if (!law().acts()) return;
  traits.linear = false;
  if (stop) traits.smooth = false;
  if (!law().dissipates()) return;
  traits.damping_matrix = traits.dissipative = true;
  traits.conservative = false;
}

}  // namespace orthodyn
