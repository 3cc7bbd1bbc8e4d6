#include "lib/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lib/material/material.h"
#include "lib/scene/added_laws.h"
#include "lib/scene/mesh_materials.h"

namespace orthodyn {

template <>
struct EnumNames<MassKind> {
  static constexpr std::array<std::pair<MassKind, const char*>, 2> list{
      {{MassKind::lumped, "lumped"}, {MassKind::consistent, "consistent"}}};
};
template <>
struct EnumNames<Start> {
  static constexpr std::array<std::pair<Start, const char*>, 2> list{
      {{Start::rest, "rest"}, {Start::equilibrium, "equilibrium"}}};
};

const Spec<TimeSpan>& TimeSpan::spec() {
  static const auto s = Spec<TimeSpan>()
                            .key("start", &TimeSpan::start, "Initial time.", {.unit = "s"})
                            .key("end", &TimeSpan::end, "Final time.", {.required = true, .unit = "s"});
  return s;
}

const Spec<Clamp>& Clamp::spec() {
  static const auto s = selection_spec<Clamp>()
                            .key("name", &Clamp::name, "Name of its reaction; default clamp_1, clamp_2 and so on.")
                            .key("components", &Clamp::components, "Components that are fixed.")
                            .check([](const Clamp& clamp, const Config& config) {
                              clamp.check(config);
                              if (clamp.components.empty())
                                config.at("components").fail("is empty; give some of x, y, z");
                            });
  return s;
}

ParameterPaths Value<ParameterPaths>::read(const Config& c, const Rule& r) {
  const auto paths = Value<std::vector<std::string>>::read(c, r);
  ParameterPaths out(paths.begin(), paths.end());
  for (std::size_t i = 0; i < out.size(); ++i)
    if (std::count(out.begin(), out.end(), out[i]) > 1) c.at(i).fail(fmt::format("'{}' is given twice", out[i]));
  out.origin = {c.where()};
  return out;
}

const Spec<Statics>& Statics::spec() {
  static const auto s = LoadStepping::spec_for<Statics>().key(
      "solver", &Statics::solver, "Finds the equilibrium of each load step.", {.fallback = "{type: kinsol}"});
  return s;
}

const Spec<Buckling>& Buckling::spec() {
  static const auto s = Spec<Buckling>().key(
      "count", &Buckling::count, "Number of critical load factors, counted from the lowest.", {.range = {1, 1000}});
  return s;
}

const Spec<Scene>& Scene::spec() {
  const Condition kDynamic{"analysis", "dynamic"};
  static const auto s =
      Spec<Scene>()
          .key(
              "analysis", &Scene::analysis,
              "dynamic: the motion over time. static: the equilibrium under all loads, which grow step by step. "
              "buckling: linear buckling loads and shapes of the undeformed body. harmonic: the steady vibration under "
              "loads with the factor `harmonic`, over a range of frequencies.")
          .key("mesh", &Scene::mesh, "The mesh: a generated shape, or a mesh file.", {.required = true})
          .key("materials", &Scene::materials,
               "Materials by name. Default: the materials and the axes of the regions from the mesh file (.veg, .inp).")
          .key("regions", &Scene::regions,
               "Material and axes of each region of the mesh by its name, or of `all`; default: the only material "
               "everywhere.")
          .key("elasticity", &Scene::elasticity, "Kinematics of the elastic law.")
          .key("mass", &Scene::given_mass, "Mass matrix; default lumped, in scenes with rigid regions consistent.")
          .key("damping", &Scene::damping, "Rayleigh damping.")
          .key("moisture", &Scene::moisture,
               "Change of the moisture content, by which materials with `expansion: {moisture: ...}` swell or shrink.")
          .key("temperature", &Scene::temperature,
               "Change of the temperature, by which materials with `expansion: {temperature: ...}` expand.")
          .key("activation", &Scene::activation,
               "Activation, by which materials with `fibres: {active: ...}` contract.")
          .key("gravity", &Scene::gravity, "Acceleration of free fall.", {.unit = "m/s^2"})
          .key("loads", &Scene::loads, "Loads on surfaces.")
          .key("terms", &Scene::terms, "Further terms by type; docs/extend.md explains how to add your own.")
          .key("clamps", &Scene::clamps, "Fixed nodes.")
          .key("motions", &Scene::motions, "Nodes whose motion is prescribed.")
          .key("joints", &Scene::joints,
               "Connections of bodies: ball joints, hinges, sliders, rods and struts, with springs, stops, friction, "
               "loads and motors.",
               {.with = kDynamic})
          .key("ties", &Scene::ties, "Surfaces of bodies that are glued together; their meshes need not match.")
          .key("start", &Scene::start,
               "rest: from the rest shape. equilibrium: from the static equilibrium under the loads at the start.",
               {.with = kDynamic})
          .key("initial", &Scene::initial, "Initial state; default at rest.", {.with = kDynamic})
          .key("time", &Scene::time,
               "Time span; optional in a static analysis, which evaluates the factors of loads at the end of the span.",
               {.fallback = "{end: 0}"})
          .key("integrator", &Scene::integrator, "Time integrator.", {.fallback = "{type: auto}", .with = kDynamic})
          .key("statics", &Scene::statics, "Equilibrium solver, for analysis: static and start: equilibrium.")
          .key("buckling", &Scene::buckling, "Options of a buckling analysis.",
               {.with = Condition{"analysis", "buckling"}})
          .key("harmonic", &Scene::harmonic, "Frequencies and damping of a harmonic analysis.",
               {.with = Condition{"analysis", "harmonic"}})
          .key("events", &Scene::events,
               "Thresholds of quantities; a crossing is logged to events.csv or ends the run.", {.with = kDynamic})
          .key("output", &Scene::output, "Output files.")
          .key("sensitivities", &Scene::sensitivities,
               "Numbers of the scene by their paths, such as materials.wood.young.0: sensitivities.csv gets the "
               "derivatives of probes, gauges, reactions and energies, or of critical load factors, with respect to "
               "them. For "
               "analysis: static, buckling and harmonic, and for motions with cvode_bdf, cvode_adams or ida_bdf.")
          .key("checkpoint", &Scene::checkpoint,
               "Save the state at intervals, so that `orthodyn run --resume` can continue after a crash; {}: every "
               "minute.",
               {.with = kDynamic})
          .key("threads", &Scene::threads,
               "Threads of a run; default: the number of hardware threads. Element loops give identical results with "
               "any number of threads. Points of studies run with one thread.",
               {.range = kThreads})
          .key("expect", &Scene::expect, "Reference values, which `orthodyn verify` checks.");
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
    config.at("statics").fail("has no effect in a run that starts from rest; remove it, or set start: equilibrium");
  if (needs_statics && !scene.statics) scene.statics = Statics::spec().read(config.fill("statics", "{}"));
  if (const auto& initial = scene.initial; needs_statics && initial)
    if (initial->deformation_gradient || initial->displacement_field || initial->noise)
      config.at("initial").fail(
          "start: equilibrium determines the shape; remove deformation_gradient, displacement_field and noise");
}

bool varies_in_time(const SupportMotion& motion) {
  if (motion.displacement)
    return std::any_of(motion.displacement->begin(), motion.displacement->end(),
                       [](const TimePointFormula& formula) { return formula.uses("t"); });
  return motion.factor && !motion.factor->constant();
}

// Calls `check` with the factor in time of each load, and with the load's section.
void for_each_factor(const Config& config, const Scene& scene,
                     const std::function<void(const TimeFunction&, const Config&)>& check) {
  for (std::size_t k = 0; k < scene.loads.size(); ++k) check(*scene.loads[k].factor, config.at("loads").at(k));
  for (std::size_t k = 0; k < scene.terms.size(); ++k)
    if (const TimeFunction* factor = scene.terms[k]->factor_in_time()) check(*factor, config.at("terms").at(k));
  for (std::size_t k = 0; k < scene.joints.size(); ++k)
    if (scene.joints[k].load) check(*scene.joints[k].load->factor, config.at("joints").at(k).at("load"));
}

void refuse_harmonic_factors(const Config& config, const Scene& scene) {
  constexpr const char* kMessage =
      "factor: {type: harmonic} needs analysis: harmonic; a vibration in time is factor: {type: sine, frequency: ...}";
  for_each_factor(config, scene, [](const TimeFunction& factor, const Config& load) {
    if (factor.is_harmonic()) load.fail(kMessage);
  });
  for (const SupportMotion& motion : scene.motions)
    if (motion.factor && motion.factor->is_harmonic()) motion.origin.fail(kMessage);
}

// Fields make no vibrations: in a harmonic analysis they are constant.
void refuse_harmonic_fields(const Scene& scene) {
  const auto check = [](const auto& field) {
    if (field && field->factor->is_harmonic())
      field->origin.fail("factor: {type: harmonic} is for loads; a field of a motion may have factor: {type: sine}");
  };
  check(scene.moisture);
  check(scene.temperature);
  check(scene.activation);
}

// Statics evaluate everything at one time, which the user must give.
void require_time_of_statics(const Config& config, const Scene& scene) {
  constexpr const char* kAsk = "the factor varies in time: give time: {end: ...}, at which statics evaluate it";
  for_each_factor(config, scene, [](const TimeFunction& factor, const Config& load) {
    if (!factor.constant()) load.fail(kAsk);
  });
  for (std::size_t k = 0; k < scene.terms.size(); ++k) {
    Traits traits;
    scene.terms[k]->declare(traits);
    if (traits.time_dependent) config.at("terms").at(k).fail(kAsk);
  }
  for (const auto* change : {&scene.moisture, &scene.temperature})
    if (*change && !(*change)->constant()) (*change)->origin.fail(kAsk);
  if (scene.activation && !scene.activation->constant()) scene.activation->origin.fail(kAsk);
  for (const SupportMotion& motion : scene.motions)
    if (varies_in_time(motion))
      motion.origin.fail("the motion varies in time: give time: {end: ...}, at which statics evaluate it");
}

void check_static(const Config& config, Scene& scene, bool is_timed) {
  if (!scene.statics) scene.statics = Statics::spec().read(config.fill("statics", "{}"));
  if (!is_timed) require_time_of_statics(config, scene);
  const Config output = config.at("output");
  for (const char* key : {"interval", "frames"})
    if (output.has(key) && !output.at(key).is_null())
      output.at(key).fail("has no effect in statics, which write a frame for each load step; remove it");
  if (scene.output.times == OutputTimes::exact) output.at("times").fail("has no effect in statics; remove it");
  if (scene.output.momentum) output.at("momentum").fail("is zero in statics; remove it");
}

void check_buckling(const Config& config, Scene& scene, bool is_timed) {
  if (!is_timed) require_time_of_statics(config, scene);
  if (scene.statics)
    config.at("statics").fail("has no effect in a linear buckling analysis; remove it, or set analysis: static");
  if (!scene.motions.empty())
    config.at("motions").fail(
        "are not supported in a buckling analysis, which needs loads that grow proportionally; follow the load path "
        "with analysis: static instead");
  for (const Expectation& e : scene.expect)
    if (!e.buckling) e.origin.fail("a buckling analysis has critical load factors only: use {buckling: 1, value: ...}");
  const Output& output = scene.output;
  const Output usual;
  if (output.fields != usual.fields || !output.probes.empty() || !output.gauges.empty() || !output.extremes.empty() ||
      output.reactions || output.momentum || output.interval || output.frames || output.history)
    config.at("output").fail(
        "has no effect in a buckling analysis, which writes load factors and shapes only; remove it");
  if (!scene.buckling) scene.buckling = Buckling::spec().read(config.fill("buckling", "{}"));
}

void check_losses(const Scene& scene) {
  for (const auto& [name, loss] : scene.harmonic->losses) {
    const auto has_name = [&name = name](const auto& material) { return material.first == name; };
    if (std::none_of(scene.materials.begin(), scene.materials.end(), has_name)) {
      std::vector<std::string> names;
      for (const auto& material : scene.materials) names.push_back(material.first);
      loss.origin.fail(
          fmt::format("unknown material '{}'{}; the scene has: {}", name, did_you_mean(name, names), join(names)));
    }
  }
}

// Whether a key of the scene, or a term that is no load, can damp.
bool may_be_damped(const Scene& scene) {
  const Harmonic& harmonic = *scene.harmonic;
  return harmonic.damping_ratio > 0 || !harmonic.losses.empty() || scene.damping.has_value() ||
         std::any_of(scene.regions.begin(), scene.regions.end(),
                     [](const auto& region) { return region.second.stiffness_damping.has_value(); }) ||
         any_viscoelastic(scene) || std::any_of(scene.terms.begin(), scene.terms.end(), [](const auto& term) {
           return term->factor_in_time() == nullptr;
         });
}

// Springs, dashpots and the ground are tied to points in space, which do not move with the supports.
void require_no_anchors(const Config& config, const Scene& scene) {
  for (std::size_t k = 0; k < scene.terms.size(); ++k)
    if (!scene.terms[k]->factor_in_time())
      config.at("terms").at(k).fail(
          "cannot be combined with harmonic.base_acceleration, by which only the clamped nodes move: remove the term, "
          "or "
          "give a load instead of the acceleration");
}

void refuse_other_times(const Config& config, const Scene& scene) {
  for (std::size_t k = 0; k < scene.terms.size(); ++k) {
    Traits traits;
    scene.terms[k]->declare(traits);
    if (traits.time_dependent && !scene.terms[k]->factor_in_time())
      config.at("terms").at(k).fail("varies in time, which a harmonic analysis does not compute");
  }
  for (const auto* change : {&scene.moisture, &scene.temperature})
    if (*change && !(*change)->constant())
      (*change)->origin.fail("varies in time, which a harmonic analysis does not compute");
  if (scene.activation && !scene.activation->constant())
    scene.activation->origin.fail("varies in time, which a harmonic analysis does not compute");
}

bool vibrates(const Config& config, const Scene& scene) {
  bool found = scene.harmonic->base_acceleration.has_value();
  for_each_factor(config, scene, [&](const TimeFunction& factor, const Config& load) {
    found = found || factor.is_harmonic();
    if (!factor.is_harmonic() && !factor.constant())
      load.fail(
          "the factor varies in time: a load of a harmonic analysis is constant, or vibrates with factor: {type: "
          "harmonic}");
  });
  return found;
}

void check_harmonic(const Config& config, Scene& scene, bool is_timed) {
  if (!scene.harmonic) config.fail("key 'harmonic' is missing (section, with the keys 'from' and 'to' in Hz)");
  if (is_timed && (scene.time.start != 0 || scene.time.end != 0))
    config.at("time").fail("has no effect in a harmonic analysis; remove it");
  if (!scene.motions.empty())
    config.at("motions").fail(
        "are not supported in a harmonic analysis; supports that vibrate together are harmonic.base_acceleration");
  if (!vibrates(config, scene))
    config.fail(
        "no load vibrates: give a load the factor {type: harmonic}, or the supports harmonic.base_acceleration");
  if (scene.harmonic->base_acceleration) {
    if (scene.clamps.empty())
      config.at("harmonic").at("base_acceleration").fail("needs supports: the scene has no 'clamps'");
    require_no_anchors(config, scene);
  }
  refuse_other_times(config, scene);
  if (!may_be_damped(scene))
    config.at("harmonic")
        .fail(
            "nothing damps the vibration, so that amplitudes at resonances are infinite: give damping_ratio, losses of "
            "the "
            "materials, or the scene's damping");
  const Output& output = scene.output;
  const Output usual;
  if (output.fields != usual.fields || !output.extremes.empty() || output.reactions || output.momentum ||
      output.interval || output.frames || output.history)
    config.at("output").fail(
        "of a harmonic analysis has probes and gauges only: response.csv is the response at them; remove the other "
        "keys");
  if (output.probes.empty() && output.gauges.empty())
    config.fail("a harmonic analysis needs output.probes or output.gauges, the points at which the response is wanted");
  if (!scene.statics) scene.statics = Statics::spec().read(config.fill("statics", "{}"));
}

void check_expectations(Scene& scene) {
  if (scene.analysis == Analysis::buckling) return;
  const bool is_harmonic = scene.analysis == Analysis::harmonic;
  for (Expectation& e : scene.expect) {
    if (e.buckling) e.origin.fail("'buckling' needs analysis: buckling");
    if (!is_harmonic && (e.response || e.frequency))
      e.origin.fail("'response' and 'frequency' need analysis: harmonic");
    if (is_harmonic && (e.take != TimeReduction::end || e.at || e.of))
      e.origin.fail(
          "a harmonic analysis has no time: instead of take, at and of, use response: amplitude, phase, peak or "
          "peak_frequency");
    if (is_harmonic && !e.is_eigenvalue()) e.response = e.response_metric();
  }
}

bool is_given(const Config& section, const std::string& key) { return section.has(key) && !section.at(key).is_null(); }

// Reads the terms whose defaults depend on the kinematics again, with these defaults.
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

// Checks all materials, because those of plugins may not check themselves.
void require_admissible_materials(const Config& config, const Scene& scene) {
  for (const auto& [name, material] : scene.materials)
    if (const std::string why = why_inadmissible(*material); !why.empty()) {
      const Config given = config.at("materials");
      (given.is_map() && given.has(name) ? given.at(name) : given).fail("cannot be used: " + why);
    }
}

// Limits the number of output times, because their list is kept in memory. Runs with a million or more need --yes.
void require_countable_times(const Config& config, const Scene& scene) {
  constexpr double kMost = 1e9;
  const double span = scene.time.end - scene.time.start;
  const auto& [interval, history] = std::pair(scene.output.interval, scene.output.history);
  if (interval && span / *interval > kMost)
    config.at("output")
        .at("interval")
        .fail(fmt::format("gives {:.2g} frames, more than {:.0e}; increase it", span / *interval, kMost));
  if (history && history->interval && span / *history->interval > kMost)
    config.at("output")
        .at("history")
        .at("interval")
        .fail(fmt::format("gives {:.2g} rows, more than {:.0e}; increase it", span / *history->interval, kMost));
}

void check_sensitivities(const Scene& scene) {
  if (scene.sensitivities.empty()) return;
  if (scene.harmonic && any_viscoelastic(scene))
    scene.sensitivities.origin.fail(
        "are not available in harmonic analyses with viscoelastic materials: use losses instead, or leave them out");
  if (scene.integrator && !scene.integrator->computes_sensitivities())
    scene.sensitivities.origin.fail(
        "are integrated with the motion, which this integrator does not do: set integrator.type to cvode_bdf, "
        "ida_bdf, or cvode_adams with Newton's method");
}

Places places_of(const Config& config) {
  std::map<std::string, std::string> sections;
  for (const std::string& key : config.keys()) sections[key] = config.at(key).where();
  return {config.file(), std::move(sections)};
}

}  // namespace

Scene read_scene(const Config& input) {
  const Config config = input.resolving();
  if (config.is_map() && config.has("scenes"))
    config.at("scenes").fail("is not a key of a scene; run a comparison of scenes by `orthodyn compare`");
  const bool is_timed = config.is_map() && config.has("time") && !config.at("time").is_null();
  Scene scene = Scene::spec().read(config);
  scene.places = places_of(config);
  complete_terms(config, scene);
  switch (scene.analysis) {
    case Analysis::dynamic: check_dynamic(config, scene, is_timed); break;
    case Analysis::statical: check_static(config, scene, is_timed); break;
    case Analysis::buckling: check_buckling(config, scene, is_timed); break;
    case Analysis::harmonic: check_harmonic(config, scene, is_timed); break;
  }
  if (scene.analysis != Analysis::harmonic) refuse_harmonic_factors(config, scene);
  refuse_harmonic_fields(scene);
  check_sensitivities(scene);
  check_expectations(scene);
  if (!config.has("materials")) fill_mesh_materials(config, scene);
  if (scene.materials.empty()) config.at("materials").fail("is empty; give at least one material");
  if (scene.harmonic) check_losses(scene);
  require_admissible_materials(config, scene);
  complete_regions(config, scene);
  check_added_laws(config, scene);
  require_countable_times(config, scene);
  return scene;
}

}  // namespace orthodyn
