#include "tools/orthodyn/list_chapters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <initializer_list>

#include "lib/config/registry.h"
#include "lib/fem/fem_model.h"
#include "lib/fem/nodal_fields.h"
#include "lib/linear/solver.h"
#include "lib/material/presets.h"
#include "lib/mesh/io/mesh_format.h"
#include "lib/scene/quantity.h"
#include "lib/scene/scene.h"
#include "lib/study/compare/comparison.h"
#include "lib/study/fit/fit.h"
#include "lib/study/stability/stability.h"
#include "lib/study/sweep/sweep.h"

namespace orthodyn {

namespace {

void print_key(const Key& key) {
  std::string facts = type_text(key.schema);
  if (!key.unit.empty()) facts += ", " + key.unit;
  if (const auto range = range_text(key.range); !range.empty()) facts += ", " + range;
  facts += key.required ? ", required" : key.fallback.empty() ? "" : ", default " + key.fallback;
  fmt::print("    {:<22} {} ({})\n", key.name, key.sentence, facts);
}

void print_entry(const std::string& name, const std::string& sentence, const std::vector<Key>& keys) {
  fmt::print("  {}\n    {}\n", name, sentence);
  for (const auto& key : keys) print_key(key);
}

template <class Base>
void list_registry() {
  for (const auto& [name, entry] : Registry<Base>::entries()) {
    std::string sentence = entry.sentence;
    for (const auto& [fact, text] : entry.facts) sentence += fmt::format("\n    {}: {}", fact, text);
    print_entry(name, sentence, entry.keys);
  }
}

void list_meshes() {
  list_registry<MeshSource>();
  fmt::print("  endings of mesh files: {}\n", known_mesh_endings());
}

void print_strength(const Strength& strength) {
  const auto three = [](const Vec3& pascal) {
    const Vec3 v = 1e-6 * pascal;
    return fmt::format("{:.4g}, {:.4g}, {:.4g}", v[0], v[1], v[2]);
  };
  fmt::print("    strengths along 1, 2, 3: tension {}; compression {}; shear 12, 23, 31: {} MPa\n",
             three(strength.tension), three(strength.compression), three(strength.shear));
}

void list_presets() {
  for (const auto& p : presets()) {
    const auto& c = p.constants;
    const auto reverse = [&](double nu, int i, int j) { return nu * c.young[j] / c.young[i]; };
    constexpr double kGiga = 1e9;
    fmt::print("  {}\n    {}. {}\n", p.name, p.source, p.axes);
    fmt::print("    density {}\n",
               p.density ? fmt::format("{} kg/m^3", *p.density) : "must be given: not in the source");
    fmt::print("    E1 {:.4g}, E2 {:.4g}, E3 {:.4g}, G12 {:.4g}, G23 {:.4g}, G13 {:.4g} GPa\n", c.young[0] / kGiga,
               c.young[1] / kGiga, c.young[2] / kGiga, c.g12 / kGiga, c.g23 / kGiga, c.g13 / kGiga);
    fmt::print("    nu12 {}, nu23 {}, nu13 {} (nu21 {:.3g}, nu32 {:.3g}, nu31 {:.3g})\n", c.nu12, c.nu23, c.nu13,
               reverse(c.nu12, 0, 1), reverse(c.nu23, 1, 2), reverse(c.nu13, 0, 2));
    if (p.strength) print_strength(*p.strength);
    if (p.expansion && p.expansion->moisture) {
      const Vec3 shrinkage = 100 * *p.expansion->moisture;
      fmt::print("    expansion along 1, 2, 3: {:.3g}, {:.3g}, {:.3g} % per per cent of moisture\n", shrinkage[0],
                 shrinkage[1], shrinkage[2]);
    }
  }
}

void list_solvers() {
  for (const auto& [name, kind] : solver_registry())
    print_entry(name, kind.sentence + (kind.unavailable.empty() ? "" : " Not available: " + kind.unavailable + "."),
                {});
}

void list_terms() {
  print_entry("elasticity", "Corotational or linear elasticity of every region.", Elasticity::spec().keys());
  print_entry("damping", "Rayleigh damping; the stiffness part is objective.", Damping::spec().keys());
  print_entry("gravity", "Uniform gravity: three numbers, m/s^2.", {});
  print_entry("loads", "Dead tractions and total forces on surfaces, with a factor in time.", Load::spec().keys());
  print_entry("clamps", "Nodes that do not move; eliminated from the system.", Clamp::spec().keys());
  print_entry("clamps.<n>.box", "Nodes in a box.", BoxSelection::spec().keys());
  print_entry("clamps.<n>.plane", "Nodes on a plane.", PlaneSelection::spec().keys());
  print_entry("motions", "Nodes whose motion is prescribed; eliminated from the system.", SupportMotion::spec().keys());
  print_entry("motions.<n>.rotation", "A rotation of any size about an axis.", Rotation::spec().keys());
  list_registry<TermChoice>();
  print_entry("initial", "The state at the start.", Initial::spec().keys());
  print_entry("initial.noise", "Random displacements of the free coordinates.", Noise::spec().keys());
}

const char* sentence_of(JointType type) {
  switch (type) {
    case JointType::ball: return "Holds the point `at` of both bodies together.";
    case JointType::fixed: return "Holds the point `at` of both bodies together, which do not turn against each other.";
    case JointType::hinge:
      return "Holds the points `from` and `to` of both bodies together: they turn about the line through them.";
    case JointType::distance:
      return "Keeps the distance of `from` on the first body and `to` on the second one, a massless rod, or prescribes "
             "it by a motor.";
    case JointType::slot:
      return "Holds the point `from` of the first body on the line of the second one through `from` and `to`.";
    case JointType::cylindrical:
      return "Holds the points `from` and `to` of the first body on this line of the second one: it slides and turns.";
    case JointType::slider: return "As cylindrical, without turning about the line.";
    case JointType::strut:
      return "Holds nothing: forces act along the line between `from` on the first body and `to` on the second one.";
  }
  return "";
}

// The keys of a type of joint; points that it needs are required.
std::vector<Key> keys_of(JointType type) {
  JointInput joint;
  joint.type = type;
  std::vector<Key> out;
  for (Key key : JointInput::spec().keys()) {
    const auto is_any_of = [&](std::initializer_list<const char*> names) {
      return std::find(names.begin(), names.end(), key.name) != names.end();
    };
    if (is_any_of({"type"}) || is_any_of(joint.is_at_a_point() ? std::initializer_list<const char*>{"from", "to"}
                                                               : std::initializer_list<const char*>{"at"}))
      continue;
    if (is_any_of({"spring", "stop", "friction", "load"}) && !joint.may_have_forces()) continue;
    if (is_any_of({"motor"}) && !joint.may_have_motor()) continue;
    if (is_any_of({"along"}) && type != JointType::cylindrical) continue;
    key.required = key.required || is_any_of({"at", "from", "to"});
    out.push_back(key);
  }
  return out;
}

void list_joints() {
  for (const auto& [type, name] : EnumNames<JointType>::list) print_entry(name, sentence_of(type), keys_of(type));
  print_entry("joints.<n>.first", "Nodes of a body that hold the joint; second likewise.", JointEnd::spec().keys());
  print_entry("joints.<n>.spring", "Spring and damping along the coordinate.", JointSpring::spec().keys());
  print_entry("joints.<n>.stop", "Limits of the coordinate.", JointStop::spec().keys());
  print_entry("joints.<n>.friction", "Friction against changes of the coordinate.", JointFriction::spec().keys());
  print_entry("joints.<n>.load", "Force or torque along the coordinate.", JointLoading::spec().keys());
  print_entry("joints.<n>.motor", "The coordinate is prescribed in time.", JointDrive::spec().keys());
}

void list_scene() {
  print_entry("scene", "The keys of a scene.", Scene::spec().keys());
  print_entry("time", "Time span.", TimeSpan::spec().keys());
  print_entry("regions.<name>", "Material, axes and kinematics of a region.", Region::spec().keys());
  print_entry("output", "What is written.", Output::spec().keys());
  print_entry("output.probes.<name>", "A point whose fields are recorded.", Probe::spec().keys());
  print_entry("output.gauges.<name>", "A strain gauge between two points.", Gauge::spec().keys());
}

void list_expectations() {
  print_entry("expect.<n>", "A quantity that `orthodyn verify` checks.", Expectation::spec().keys());
}

void list_statics() {
  print_entry("statics", "How equilibria are computed, for analysis: static and start: equilibrium.",
              Statics::spec().keys());
  list_registry<EquilibriumChoice>();
}

void list_buckling() {
  print_entry("buckling", "Computation of critical load factors, for analysis: buckling.", Buckling::spec().keys());
}

void list_harmonic() {
  print_entry("harmonic", "Frequencies and damping, for analysis: harmonic.", Harmonic::spec().keys());
  print_entry("harmonic.losses.<material>", "Loss factors of a material.", MaterialLoss::spec().keys());
}

void list_events() {
  print_entry("events.<n>", "A value of a quantity whose crossing is logged or ends the run.",
              EventSpec::spec().keys());
}

void list_comparison() {
  print_entry("comparison", "The keys of a comparison, for `orthodyn compare`.", Comparison::spec().keys());
  print_entry("scenes.<n>", "A scene of a comparison.", SceneEntry::spec().keys());
  print_entry("limits", "Limits of each point of a comparison.", Limits::spec().keys());
  print_entry("reference", "The reference solution, against which errors are measured.",
              ReferenceOptions::spec().keys());
}

void list_sweep() {
  print_entry("sweep", "The keys of a sweep, for `orthodyn sweep`.", Sweep::spec().keys());
  print_entry("scene", "The scene of a sweep, as a section.", SceneEntry::spec().keys());
  print_entry("vary.<name>", "Evenly spaced numbers.", NumberRange::spec().keys());
  print_entry("vary.<name>", "A list with a unit or a name.", ValueList::spec().keys());
  print_entry("quantities.<name>", "A metric of every point: one of quantity, mode (or along), buckling, cost.",
              WantedMetric::spec().keys());
  print_entry("plots.<n>", "A plot of the report.", PlotSpec::spec().keys());
  print_entry("frames", "A picture of each point.", FrameSpec::spec().keys());
  print_entry("limits", "Limits of each point of a sweep.", Limits::spec().keys());
}

void list_fit() {
  using namespace study::fit;
  print_entry("fit", "The keys of a fit, for `orthodyn fit`.", Fit::spec().keys());
  print_entry("experiments.<name>", "A scene with measured values; candidates likewise.", Experiment::spec().keys());
  print_entry("measured.<n>", "One measured value, natural frequencies, or a table.", Measurement::spec().keys());
  print_entry("parameters.<name>", "A number of the scenes that is to be found, as a section.",
              Parameter::spec().keys());
  print_entry("prior", "What is known of a parameter without the measurements.", Prior::spec().keys());
  print_entry("limits", "Limits of each run of a fit.", Limits::spec().keys());
}

void list_stability() {
  print_entry("stability", "The keys of a file of hard cases, for `orthodyn stability`.", Stability::spec().keys());
  print_entry("cases.<n>", "A hard case.", HardCase::spec().keys());
  print_entry("limits", "Limits of each trial.", Limits::spec().keys());
}

void list_fields() {
  const FemModel model{FemModel::Parts{}};
  for (const auto& info : model.outputs()) {
    if (info.location == Location::global) continue;
    fmt::print("  {:<18} {} ({}, {} component{}, {})\n", info.name, info.sentence,
               info.location == Location::node ? "per node" : "per cell", info.components,
               info.components == 1 ? "" : "s", info.unit);
  }
}

void list_quantities() {
  const FemModel model{FemModel::Parts{}};
  for (const auto& info : model.outputs())
    if (info.location == Location::global)
      fmt::print("  {:<22} {} ({} component{}, {})\n", info.name, info.sentence, info.components,
                 info.components == 1 ? "" : "s", info.unit);
  fmt::print("  {:<22} Drift of the energy balance (1 component, J)\n", kEnergyBalance);
  fmt::print("  PROBE.FIELD            A field per node (`orthodyn list fields`) at a probe of the scene.\n");
  fmt::print(
      "  reaction.SUPPORT       Force of a clamp or a moved support on the body, by its name (3 components, N).\n");
  fmt::print(
      "  torque.SUPPORT         Torque of that force about the centre of the support's nodes (3 components, N m).\n");
  fmt::print("                         Both need output.reactions: true, unless `expect` names them.\n");
  fmt::print("  joint.JOINT            Force of a joint on its first body, by its name (3 components, N).\n");
  fmt::print(
      "  joint_torque.JOINT     Torque of a hinge, slider, cylindrical or fixed joint on its first body, about its\n");
  fmt::print("                         point `at` or `from` (3 components, N m).\n");
  fmt::print(
      "  coordinate.JOINT       On which springs, stops, friction, loads and motors of a joint act (1 component):\n");
  fmt::print(
      "                         the distance (m) along the line, the angle (rad) about it, or the change of the\n");
  fmt::print("                         distance (m) of the points of a strut or a driven distance.\n");
  fmt::print(
      "  slide.JOINT, angle.JOINT\n"
      "                         Distance (m) along the line of a cylindrical joint, and angle (rad) about it (1 "
      "component).\n");
  fmt::print("                         Angles count all turns since the start.\n");
  fmt::print(
      "  motor.JOINT            Force (N) or torque (N m) of a joint's motor on its first body (1 component).\n");
  fmt::print("  joints.gap             Largest distance of joined points, and change of rods (1 component, m).\n");
  fmt::print("  joints.rate            Largest rate of these distances (1 component, m/s).\n");
  fmt::print("  tie.TIE                Force of the second surface of a tie on the first one (3 components, N).\n");
  fmt::print("  contact.CONTACT        Force of a contact on its first surface, or of the ground (3 components, N).\n");
  fmt::print("  contact_pressure.CONTACT\n");
  fmt::print("                         Largest pressure of a contact (1 component, Pa).\n");
  fmt::print("  [REGION.]FIELD.largest, .smallest\n");
  fmt::print(
      "                         Over the nodes of the body or a region; tensors with a component "
      "(nodal_stress.xx.largest):\n");
  for (const OutputInfo& info : region_fields())
    fmt::print("                         {}{}\n", info.name,
               info.component_names.empty() ? "" : fmt::format(" .{}", fmt::join(info.component_names, " .")));
}

}  // namespace

const std::vector<std::pair<std::string, std::function<void()>>>& list_chapters() {
  static const std::vector<std::pair<std::string, std::function<void()>>> all = {
      {"scene", list_scene},
      {"materials", list_registry<Material>},
      {"presets", list_presets},
      {"meshes", list_meshes},
      {"axes", list_registry<AxesSource>},
      {"terms", list_terms},
      {"joints", list_joints},
      {"factors", list_registry<TimeFunction>},
      {"integrators", list_registry<IntegratorChoice>},
      {"solvers", list_solvers},
      {"statics", list_statics},
      {"buckling", list_buckling},
      {"harmonic", list_harmonic},
      {"events", list_events},
      {"expect", list_expectations},
      {"comparison", list_comparison},
      {"sweep", list_sweep},
      {"fit", list_fit},
      {"stability", list_stability},
      {"fields", list_fields},
      {"quantities", list_quantities},
  };
  return all;
}

}  // namespace orthodyn
