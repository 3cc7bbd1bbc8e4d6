#include "lib/scene/scene.h"

#include "lib/scene/mesh_materials.h"

namespace orthodyn {

template <>
struct Words<OutputTimes> {
  static constexpr std::array<std::pair<OutputTimes, const char*>, 2> list{
      {{OutputTimes::interpolated, "interpolated"}, {OutputTimes::exact, "exact"}}};
};
template <>
struct Words<MassKind> {
  static constexpr std::array<std::pair<MassKind, const char*>, 2> list{
      {{MassKind::lumped, "lumped"}, {MassKind::consistent, "consistent"}}};
};
template <>
struct Words<Kinematics> {
  static constexpr std::array<std::pair<Kinematics, const char*>, 2> list{
      {{Kinematics::corotational, "corotational"}, {Kinematics::linear, "linear"}}};
};
template <>
struct Words<Corotation> {
  static constexpr std::array<std::pair<Corotation, const char*>, 2> list{
      {{Corotation::exact, "exact"}, {Corotation::warped, "warped"}}};
};
template <>
struct Words<WarpedTangent> {
  static constexpr std::array<std::pair<WarpedTangent, const char*>, 2> list{
      {{WarpedTangent::rotated, "rotated"}, {WarpedTangent::unsymmetric, "unsymmetric"}}};
};

template <>
struct Words<Analysis> {
  static constexpr std::array<std::pair<Analysis, const char*>, 2> list{
      {{Analysis::dynamic, "dynamic"}, {Analysis::statical, "static"}}};
};
template <>
struct Words<Start> {
  static constexpr std::array<std::pair<Start, const char*>, 2> list{
      {{Start::rest, "rest"}, {Start::equilibrium, "equilibrium"}}};
};

const Spec<Clamp>& Clamp::spec() {
  static const auto s = selection_spec<Clamp>()
                            .key("name", &Clamp::name, "For its reaction; default clamp_1, clamp_2 and so on.")
                            .key("components", &Clamp::components, "Which coordinates are held.")
                            .check([](const Clamp& clamp, const Config& config) {
                              clamp.check(config);
                              if (clamp.components.empty())
                                config.at("components").fail("is empty; give some of x, y, z");
                            });
  return s;
}

const Spec<Load>& Load::spec() {
  static const auto s =
      Spec<Load>()
          .key("surface", &Load::surface, "A named surface of the mesh.", {.required = true})
          .key("traction", &Load::traction, "Dead traction per undeformed area.", {.unit = "Pa"})
          .key("force", &Load::force, "Total dead force, spread evenly over the surface.", {.unit = "N"})
          .key("factor", &Load::factor, "Factor in time.", {.fallback = "{type: constant}"})
          .check([](const Load& load, const Config& config) {
            if (load.traction.has_value() == load.force.has_value())
              config.fail("give exactly one of traction, force");
          });
  return s;
}

const Spec<Damping>& Damping::spec() {
  static const auto s =
      Spec<Damping>()
          .key("mass", &Damping::mass, "Mass-proportional (Rayleigh alpha): drag on all motion.",
               {.unit = "1/s", .range = kNonNegative})
          .key("stiffness", &Damping::stiffness,
               "Stiffness-proportional (Rayleigh beta), objective: rigid motion is free of it.",
               {.unit = "s", .range = kNonNegative});
  return s;
}

const Spec<Region>& Region::spec() {
  static const auto s =
      Spec<Region>()
          .key("material", &Region::material, "One of `materials`.", {.required = true})
          .key("axes", &Region::axes, "Directions of the material axes, the same everywhere or following the shape.",
               {.fallback = "{type: directions}"})
          .key("stiffness_damping", &Region::stiffness_damping, "Overrides damping.stiffness here.",
               {.unit = "s", .range = kNonNegative});
  return s;
}

const Spec<Elasticity>& Elasticity::spec() {
  static const auto s =
      Spec<Elasticity>()
          .key("kinematics", &Elasticity::kinematics, "Large rotations, or small strain with a constant K.")
          .key("corotation", &Elasticity::corotation,
               "exact: gradient of the energy. warped: R sigma as in Mueller & Gross 2004 and Vega FEM, for "
               "comparison; it gains energy and exerts a net torque for anisotropic materials.")
          .key("warped_tangent", &Elasticity::warped_tangent,
               "Of the warped force: R K R^T, or its exact unsymmetric derivative (klu, klu_full).")
          .check([](const Elasticity& e, const Config& config) {
            const bool warped = e.corotation == Corotation::warped;
            if (warped && e.kinematics == Kinematics::linear)
              config.at("corotation").fail("has no meaning with kinematics: linear; remove one of them");
            if (e.warped_tangent == WarpedTangent::unsymmetric && !warped)
              config.at("warped_tangent").fail("has no meaning without corotation: warped; remove it");
          });
  return s;
}

const Spec<Noise>& Noise::spec() {
  static const auto s =
      Spec<Noise>()
          .key("amplitude", &Noise::amplitude, "Largest offset of each free coordinate, uniform.",
               {.required = true, .unit = "m", .range = kNonNegative})
          .key("seed", &Noise::seed, "Seed of the generator.", {.range = kNonNegative});
  return s;
}

const Spec<Initial>& Initial::spec() {
  static const auto s =
      Spec<Initial>()
          .key("velocity", &Initial::velocity, "Rigid velocity.", {.unit = "m/s"})
          .key("spin", &Initial::spin, "Rigid angular velocity about the centre.", {.unit = "rad/s"})
          .key("velocity_field", &Initial::velocity_field,
               "Velocity added to the rigid one: three formulas of the rest position.", {.unit = "m/s"})
          .key("center", &Initial::center, "Centre of spin and deformation; default the centre of mass.",
               {.unit = "m"})
          .key("deformation_gradient", &Initial::deformation_gradient,
               "Uniform F about the centre; a singular one flattens the body, a negative determinant mirrors it.")
          .key("displacement_field", &Initial::displacement_field,
               "Displacement added to the uniform one: three formulas of the rest position.", {.unit = "m"})
          .key("noise", &Initial::noise, "Random offsets.");
  return s;
}

const Spec<TimeSpan>& TimeSpan::spec() {
  static const auto s = Spec<TimeSpan>()
                            .key("start", &TimeSpan::start, "Initial time.", {.unit = "s"})
                            .key("end", &TimeSpan::end, "Final time.", {.required = true, .unit = "s"});
  return s;
}

const Spec<Probe>& Probe::spec() {
  static const auto s =
      Spec<Probe>()
          .key("at", &Probe::at, "The node nearest to this point of the rest shape.",
               {.required = true, .unit = "m"})
          .key("fields", &Probe::fields, "Node fields to record.");
  return s;
}

const Spec<Output>& Output::spec() {
  static const auto s =
      Spec<Output>()
          .key("interval", &Output::interval, "Time between frames.", {.unit = "s", .range = kPositive})
          .key("frames", &Output::frames, "Frames after the initial one, evenly spaced; default 50.",
               {.range = {0, 1e6}})
          .key("times", &Output::times,
               "interpolated: frames from the integrator's own polynomial; exact: steps end on them.")
          .key("fields", &Output::fields, "Node and cell fields of the frames (see `orthodyn list fields`).")
          .key("probes", &Output::probes, "Named points whose fields go to probes.csv.")
          .key("reactions", &Output::reactions,
               "Record force and torque of every clamp and motion on the body in probes.csv.")
          .key("energy", &Output::energy, "Write energy.csv.")
          .key("steps", &Output::steps, "Write steps.csv.")
          .key("momentum", &Output::momentum, "Write momentum.csv.")
          .check([](const Output& output, const Config& config) {
            if (output.interval && output.frames) config.fail("give one of interval, frames");
          });
  return s;
}

const Spec<CheckpointSchedule>& CheckpointSchedule::spec() {
  static const auto s =
      Spec<CheckpointSchedule>()
          .key("every", &CheckpointSchedule::every, "Wall time between checkpoints.", {.unit = "s", .range = kPositive})
          .key("frames", &CheckpointSchedule::frames, "Also after every so many frames.", {.range = {1, 1e6}});
  return s;
}

const Spec<Scene>& Scene::spec() {
  const Condition kDynamic{"analysis", "dynamic"};
  static const auto s =
      Spec<Scene>()
          .key("analysis", &Scene::analysis,
               "dynamic: the motion over time. static: the equilibrium under all loads, which grow step by step.")
          .key("mesh", &Scene::mesh, "Where the mesh comes from.", {.required = true})
          .key("materials", &Scene::materials, "Materials by name; required unless the mesh file brings them (.veg).")
          .key("regions", &Scene::regions,
               "Material and axes of each region of the mesh by its name, or of `all`; default: the only "
               "material everywhere.")
          .key("elasticity", &Scene::elasticity, "Kinematics of the elastic law.")
          .key("mass", &Scene::mass, "Mass matrix.")
          .key("damping", &Scene::damping, "Rayleigh damping.")
          .key("gravity", &Scene::gravity, "Acceleration of free fall.", {.unit = "m/s^2"})
          .key("loads", &Scene::loads, "Loads on surfaces.")
          .key("terms", &Scene::terms, "Further terms by type; for those of your own see docs/extend.md.")
          .key("clamps", &Scene::clamps, "Nodes that do not move.")
          .key("motions", &Scene::motions, "Nodes whose motion is prescribed.")
          .key("start", &Scene::start,
               "rest: from the rest shape. equilibrium: from the static equilibrium under the loads at the start.",
               {.with = kDynamic})
          .key("initial", &Scene::initial, "Initial state; default at rest.", {.with = kDynamic})
          .key("time", &Scene::time,
               "Time span; in statics may be left out: its end is when factors of loads are taken.",
               {.fallback = "{end: 0}"})
          .key("integrator", &Scene::integrator, "The integrator.", {.fallback = "{type: cvode_bdf}", .with = kDynamic})
          .key("statics", &Scene::statics, "How equilibrium is found, by analysis: static and start: equilibrium.")
          .key("events", &Scene::events, "Values that quantities cross: logged to events.csv, or the end of the run.",
               {.with = kDynamic})
          .key("output", &Scene::output, "What is written.")
          .key("checkpoint", &Scene::checkpoint,
               "Keep the state every so often, so that `orthodyn run --resume` can go on after a crash; {} for "
               "every minute.",
               {.with = kDynamic})
          .key("expect", &Scene::expect, "Known figures, which `orthodyn verify` checks.");
  return s;
}

namespace {

// A missing `regions` means the only material everywhere.
void fill_regions(const Config& config, Scene& scene) {
  if (!scene.regions.empty()) return;
  if (scene.materials.size() != 1)
    config.fail("key 'regions' is missing: with " + std::to_string(scene.materials.size()) +
                " materials, say which region has which");
  const Config regions = config.fill("regions", "{all: {}}");
  regions.at("all").fill_text("material", scene.materials.front().first);
  scene.regions = Value<Named<Region>>::read(regions, {});
}

void check_materials_exist(const Scene& scene) {
  std::vector<std::string> names;
  for (const auto& [name, material] : scene.materials) names.push_back(name);
  for (const auto& [name, region] : scene.regions)
    if (std::find(names.begin(), names.end(), region.material) == names.end())
      region.origin.fail("material '" + region.material + "' is not among the materials: " + join(names));
}

void check_dynamic(const Config& config, Scene& scene, bool is_timed) {
  if (!is_timed) config.fail("key 'time' is missing (section, with the key 'end' in s)");
  if (!(scene.time.end > scene.time.start)) config.at("time").fail("'end' must be after 'start'");
  const bool needs_statics = scene.start == Start::equilibrium;
  if (scene.statics && !needs_statics)
    config.at("statics").fail("has no meaning in a run that starts from rest; remove it, or say start: equilibrium");
  if (needs_statics && !scene.statics) scene.statics = Statics::spec().read(config.fill("statics", "{}"));
  if (needs_statics && scene.initial && (scene.initial->deformation_gradient || scene.initial->noise))
    config.at("initial").fail("the shape is that of equilibrium (start); remove deformation_gradient and noise");
}

void check_static(const Config& config, Scene& scene, bool is_timed) {
  if (!scene.statics) scene.statics = Statics::spec().read(config.fill("statics", "{}"));
  for (const Load& load : scene.loads)
    if (!is_timed && !load.factor->constant())
      load.origin.fail("its factor varies in time: say by time: {end: ...} at which time the statics take it");
  const Config output = config.at("output");
  for (const char* key : {"interval", "frames"})
    if (output.has(key) && !output.at(key).is_null())
      output.at(key).fail("has no meaning in statics: there is a frame of each load step; remove it");
  if (scene.output.times == OutputTimes::exact) output.at("times").fail("has no meaning in statics; remove it");
  if (scene.output.momentum) output.at("momentum").fail("nothing moves in statics; remove it");
}

}  // namespace

Scene read_scene(const Config& input) {
  const Config config = input.resolving();
  if (config.is_map() && config.has("scenes"))
    config.at("scenes").fail("a scene has no such key; a comparison of scenes is run by `orthodyn compare`");
  const bool is_timed = config.is_map() && config.has("time") && !config.at("time").is_null();
  Scene scene = Scene::spec().read(config);
  scene.analysis == Analysis::statical ? check_static(config, scene, is_timed) : check_dynamic(config, scene, is_timed);
  if (!config.has("materials")) fill_mesh_materials(config, scene);
  if (scene.materials.empty()) config.at("materials").fail("is empty; give at least one material");
  fill_regions(config, scene);
  check_materials_exist(scene);
  const auto& interval = scene.output.interval;
  if (interval && (scene.time.end - scene.time.start) / *interval > 1e6)
    config.at("output").at("interval").fail("gives more than 1e6 frames");
  return scene;
}

}  // namespace orthodyn
