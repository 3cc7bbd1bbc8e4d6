#include "lib/study/stability/stability.h"

#include <fmt/format.h>

#include "lib/config/registry.h"
#include "lib/ode/integrator.h"
#include "lib/scene/scene.h"
#include "lib/simulation/run/scene_file.h"
#include "lib/study/inputs/labels.h"
#include "lib/study/inputs/scene_entry.h"
#include "lib/study/inputs/scene_variant.h"

namespace orthodyn {

namespace {

void check(const Stability& stability, const Config& config) {
  if (stability.cases.empty()) config.at("cases").fail("is empty; name at least one scene with an 'expect' list");
  if (stability.integrators.empty()) config.at("integrators").fail("is empty; list integrators, or 'all'");
  if (stability.variants.empty()) config.at("variants").fail("is empty; remove it to run the cases unchanged");
}

// Reads the scene, so that input errors are reported before anything runs.
Config scene_of(const SceneVariant& variant, const StabilityIntegrator& entry) {
  Config config = with_integrator(variant, entry.type, entry.options, [](const std::string&) { return true; });
  config.set("output.fields", std::vector<std::string>());
  for (const char* key : {"output.energy", "output.steps"}) config.set(key, false);
  if (read_scene(config).expect.empty())
    config.fail("has no 'expect' list, so it cannot be graded (see `orthodyn list expect`)");
  return config;
}

}  // namespace

ValueSchema Value<StabilityIntegrator>::schema() {
  auto names = Registry<IntegratorChoice>::names();
  names.insert(names.begin(), "all");
  return {.kind = ValueSchema::Kind::either,
          .items = {{.kind = ValueSchema::Kind::word, .words = "name", .names = names},
                    Value<CompleteIntegratorEntry>::schema()}};
}

StabilityIntegrator Value<StabilityIntegrator>::read(const Config& c, const Rule& rule) {
  if (c.is_map()) return {Value<CompleteIntegratorEntry>::read(c, rule)};
  return {Value<IntegratorEntry>::read(c, rule)};
}

const Spec<HardCase>& HardCase::spec() {
  static const auto s =
      Spec<HardCase>()
          .key("file", &HardCase::file, "Scene file with an `expect` list.", {.required = true})
          .key("label", &HardCase::label, "Name in the matrix; default the file's name.")
          .key("set", &HardCase::set, "Changes of the scene by path: {mesh.cells: [45, 9, 9]}.")
          .key("model", &HardCase::model,
               "Reason why no integrator can pass, if the model itself is at fault; shown in the case's row.");
  return s;
}

const Spec<Stability>& Stability::spec() {
  static const auto s =
      Spec<Stability>()
          .key("title", &Stability::title, "Heading of the report; default the file's name.")
          .key("description", &Stability::description, "One or two sentences for the report: what is tested, and why.")
          .key("cases", &Stability::cases, "Scenes with an `expect` list, or sections {file, label, set, model}.",
               {.required = true})
          .key("integrators", &Stability::integrators,
               "Names, 'all', or sections {type, label, any option of the integrator}.", {.fallback = "[all]"})
          .key("variants", &Stability::variants,
               "Named sets of changes by path, such as {warped: {elasticity.corotation: warped}}. Every case runs with "
               "each set.",
               {.fallback = "{default: {}}"})
          .key("limits", &Stability::limits, "Wall time and memory limits of each run.")
          .check(check);
  return s;
}

Stability read_stability(const Config& config) {
  refuse_other_kinds(config, InputFile::stability);
  Stability stability = Stability::spec().read(config);
  stability.name = stem(config.file());
  if (stability.title.empty()) stability.title = stability.name;
  const std::vector<IntegratorEntry> named(stability.integrators.begin(), stability.integrators.end());
  stability.integrators.clear();
  for (auto& entry : expand_all(named)) stability.integrators.push_back({std::move(entry)});
  refuse_equal_labels(stability.cases);
  refuse_equal_labels(stability.integrators);
  return stability;
}

std::vector<StabilityRun> stability_runs(const Stability& stability) {
  std::vector<StabilityRun> all;
  for (std::size_t c = 0; c < stability.cases.size(); ++c) {
    const HardCase& hard = stability.cases[c];
    const std::string text = read_scene_text(hard.file);
    for (std::size_t v = 0; v < stability.variants.size(); ++v) {
      const auto& [name, changes] = stability.variants[v];
      SceneVariant variant{hard.file.path, text, hard.set};
      variant.set.insert(variant.set.end(), changes.begin(), changes.end());
      for (std::size_t i = 0; i < stability.integrators.size(); ++i) {
        const StabilityIntegrator& integrator = stability.integrators[i];
        const std::string title = fmt::format("{}, {}, {}", hard.label, name, integrator.label);
        try {
          all.push_back({c, v, i, title, scene_of(variant, integrator)});
        } catch (const ConfigError& e) {
          throw ConfigError(e.place(), fmt::format("{} (in {})", e.message(), title));
        }
      }
    }
  }
  return all;
}

}  // namespace orthodyn
