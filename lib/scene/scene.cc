#include "lib/scene/scene.h"

#include <fmt/format.h>

#include <utility>

#include "lib/material/admissible.h"
#include "lib/scene/mesh_materials.h"

namespace orthodyn {

template <>
struct EnumNames<MassKind> {
  static constexpr std::array<std::pair<MassKind, const char*>, 2> list{
      {{MassKind::lumped, "lumped"}, {MassKind::consistent, "consistent"}}};
};
template <>
struct EnumNames<Analysis> {
  static constexpr std::array<std::pair<Analysis, const char*>, 3> list{
      {{Analysis::dynamic, "dynamic"}, {Analysis::statical, "static"}, {Analysis::buckling, "buckling"}}};
};
template <>
struct EnumNames<Start> {
  static constexpr std::array<std::pair<Start, const char*>, 2> list{
      {{Start::rest, "rest"}, {Start::equilibrium, "equilibrium"}}};
};

const Spec<Buckling>& Buckling::spec() {
  static const auto s = Spec<Buckling>().key("count", &Buckling::count,
                                             "How many critical load factors, the lowest first.", {.range = {1, 1000}});
  return s;
}

const Spec<Scene>& Scene::spec() {
  const Condition kDynamic{"analysis", "dynamic"};
  static const auto s =
      Spec<Scene>()
          .key("analysis", &Scene::analysis,
               "dynamic: the motion over time. static: the equilibrium under all loads, which grow step by step. "
               "buckling: the load factors at which the body at rest would buckle, and how (linear).")
          .key("mesh", &Scene::mesh, "Where the mesh comes from.", {.required = true})
          .key("materials", &Scene::materials,
               "Materials by name. Left out, those of the mesh file (.veg, .inp) are used, with the regions' axes.")
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
          .key("time", &Scene::time, "Time span; optional in statics, where factors of loads are evaluated at its end.",
               {.fallback = "{end: 0}"})
          .key("integrator", &Scene::integrator, "The integrator.", {.fallback = "{type: auto}", .with = kDynamic})
          .key("statics", &Scene::statics, "How equilibrium is found, for analysis: static and start: equilibrium.")
          .key("buckling", &Scene::buckling, "What a buckling analysis looks for.",
               {.with = Condition{"analysis", "buckling"}})
          .key("events", &Scene::events,
               "Values that quantities cross; a crossing is logged to events.csv or ends the run.", {.with = kDynamic})
          .key("output", &Scene::output, "What is written.")
          .key("checkpoint", &Scene::checkpoint,
               "Save the state at intervals, so that `orthodyn run --resume` can continue after a crash; {} for every "
               "minute.",
               {.with = kDynamic})
          .key("threads", &Scene::threads,
               "Threads of a run; default: as many as the machine has. Loops over elements give the same bits with any "
               "number of them. Points of studies have one.",
               {.range = kThreads})
          .key("expect", &Scene::expect, "Known figures, which `orthodyn verify` checks.");
  return s;
}

std::vector<const TermChoice*> Scene::force_terms() const {
  std::vector<const TermChoice*> all;
  if (gravity) all.push_back(&*gravity);
  for (const Load& load : loads) all.push_back(&load);
  for (const auto& term : terms) all.push_back(term.get());
  return all;
}

namespace {

void check_dynamic(const Config& config, Scene& scene, bool is_timed) {
  if (!is_timed) config.fail("key 'time' is missing (section, with the key 'end' in s)");
  if (!(scene.time.end > scene.time.start)) config.at("time").fail("'end' must be after 'start'");
  const bool needs_statics = scene.start == Start::equilibrium;
  if (scene.statics && !needs_statics)
    config.at("statics").fail("has no meaning in a run that starts from rest; remove it, or say start: equilibrium");
  if (needs_statics && !scene.statics) scene.statics = Statics::spec().read(config.fill("statics", "{}"));
  if (const auto& initial = scene.initial; needs_statics && initial)
    if (initial->deformation_gradient || initial->displacement_field || initial->noise)
      config.at("initial").fail(
          "the shape is that of equilibrium (start); remove deformation_gradient, displacement_field and noise");
}

bool varies_in_time(const SupportMotion& motion) {
  if (motion.displacement)
    return std::any_of(motion.displacement->begin(), motion.displacement->end(),
                       [](const TimePointFormula& formula) { return formula.uses("t"); });
  return motion.factor && !motion.factor->constant();
}

// Statics take all at one time, which nobody but the user knows.
void require_time_of_statics(const Config& config, const Scene& scene) {
  constexpr const char* kAsk = "its factor varies in time: say by time: {end: ...} at which time the statics take it";
  for (const Load& load : scene.loads)
    if (!load.factor->constant()) load.origin.fail(kAsk);
  for (std::size_t k = 0; k < scene.terms.size(); ++k) {
    Traits traits;
    scene.terms[k]->declare(traits);
    if (traits.time_dependent) config.at("terms").at(k).fail(kAsk);
  }
  for (const SupportMotion& motion : scene.motions)
    if (varies_in_time(motion))
      motion.origin.fail("it varies in time: say by time: {end: ...} at which time the statics take it");
}

void check_static(const Config& config, Scene& scene, bool is_timed) {
  if (!scene.statics) scene.statics = Statics::spec().read(config.fill("statics", "{}"));
  if (!is_timed) require_time_of_statics(config, scene);
  const Config output = config.at("output");
  for (const char* key : {"interval", "frames"})
    if (output.has(key) && !output.at(key).is_null())
      output.at(key).fail("has no meaning in statics: there is a frame of each load step; remove it");
  if (scene.output.times == OutputTimes::exact) output.at("times").fail("has no meaning in statics; remove it");
  if (scene.output.momentum) output.at("momentum").fail("nothing moves in statics; remove it");
}

void check_buckling(const Config& config, Scene& scene, bool is_timed) {
  if (!is_timed) require_time_of_statics(config, scene);
  if (scene.statics)
    config.at("statics").fail("has no meaning in a linear buckling analysis; remove it, or say analysis: static");
  if (!scene.motions.empty())
    config.at("motions").fail(
        "a buckling analysis takes loads that grow in proportion, and no prescribed displacements; "
        "follow the path with analysis: static and find where it becomes unstable");
  for (const Expectation& e : scene.expect)
    if (!e.buckling) e.origin.fail("a buckling analysis has critical load factors only: {buckling: 1, value: ...}");
  const Output& output = scene.output;
  const Output usual;
  if (output.fields != usual.fields || !output.probes.empty() || !output.extremes.empty() || output.reactions ||
      output.momentum || output.interval || output.frames || output.history)
    config.at("output").fail("a buckling analysis writes its load factors and shapes only; remove it");
  if (!scene.buckling) scene.buckling = Buckling::spec().read(config.fill("buckling", "{}"));
}

// A critical load factor is found by no other analysis.
void check_expectations(const Scene& scene) {
  if (scene.analysis == Analysis::buckling) return;
  for (const Expectation& e : scene.expect)
    if (e.buckling) e.origin.fail("'buckling' goes with analysis: buckling");
}

bool is_given(const Config& section, const std::string& key) { return section.has(key) && !section.at(key).is_null(); }

// Terms whose defaults depend on the kinematics are read again with them.
void complete_terms(const Config& config, Scene& scene) {
  for (std::size_t k = 0; k < scene.terms.size(); ++k) {
    const auto defaults = scene.terms[k]->defaults(scene.elasticity);
    if (defaults.empty()) continue;
    const Config term = config.at("terms").at(k);
    for (const auto& [key, yaml] : defaults)
      if (!is_given(term, key)) term.fill(key, yaml);
    scene.terms[k] = Registry<TermChoice>::read(term);
  }
}

// Those of plugins too, whose authors may not have looked.
void require_admissible_materials(const Config& config, const Scene& scene) {
  for (const auto& [name, material] : scene.materials)
    if (const std::string why = why_inadmissible(*material); !why.empty()) {
      const Config given = config.at("materials");
      (given.is_map() && given.has(name) ? given.at(name) : given).fail("cannot be computed with: " + why);
    }
}

// Their list is kept in memory; from a million on a run asks for --yes.
void require_countable_times(const Config& config, const Scene& scene) {
  constexpr double kMost = 1e9;
  const double span = scene.time.end - scene.time.start;
  const auto& [interval, history] = std::pair(scene.output.interval, scene.output.history);
  if (interval && span / *interval > kMost)
    config.at("output")
        .at("interval")
        .fail(fmt::format("gives {:.2g} frames, the most is {:.0e}; take a longer one", span / *interval, kMost));
  if (history && history->interval && span / *history->interval > kMost)
    config.at("output")
        .at("history")
        .at("interval")
        .fail(
            fmt::format("gives {:.2g} rows, the most is {:.0e}; take a longer one", span / *history->interval, kMost));
}

}  // namespace

namespace {

Places places_of(const Config& config) {
  std::map<std::string, std::string> sections;
  for (const std::string& key : config.keys()) sections[key] = config.at(key).where();
  return {config.file(), std::move(sections)};
}

}  // namespace

Scene read_scene(const Config& input) {
  const Config config = input.resolving();
  if (config.is_map() && config.has("scenes"))
    config.at("scenes").fail("a scene has no such key; a comparison of scenes is run by `orthodyn compare`");
  const bool is_timed = config.is_map() && config.has("time") && !config.at("time").is_null();
  Scene scene = Scene::spec().read(config);
  scene.places = places_of(config);
  complete_terms(config, scene);
  switch (scene.analysis) {
    case Analysis::dynamic: check_dynamic(config, scene, is_timed); break;
    case Analysis::statical: check_static(config, scene, is_timed); break;
    case Analysis::buckling: check_buckling(config, scene, is_timed); break;
  }
  check_expectations(scene);
  if (!config.has("materials")) fill_mesh_materials(config, scene);
  if (scene.materials.empty()) config.at("materials").fail("is empty; give at least one material");
  require_admissible_materials(config, scene);
  complete_regions(config, scene);
  require_countable_times(config, scene);
  return scene;
}

}  // namespace orthodyn
