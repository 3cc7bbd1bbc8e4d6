#include "lib/study/compare/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "lib/config/registry.h"
#include "lib/core/spelling.h"
#include "lib/ode/integrator.h"
#include "lib/simulation/run/scene_file.h"
#include "lib/study/inputs/labels.h"

namespace orthodyn {

template <>
struct EnumNames<ReferenceKind> {
  static constexpr std::array<std::pair<ReferenceKind, const char*>, 3> list{
      {{ReferenceKind::automatic, "automatic"}, {ReferenceKind::computed, "computed"}, {ReferenceKind::none, "none"}}};
};

namespace {

void refuse_repeated(std::vector<double> values, const Config& config, const char* key) {
  std::sort(values.begin(), values.end());
  if (std::adjacent_find(values.begin(), values.end()) != values.end()) config.at(key).fail("lists a value twice");
}

void check_varied(const std::string& path, const std::vector<YamlText>& values, const Config& at) {
  if (values.empty()) at.fail("is empty; list the values to compare");
  for (std::size_t i = 0; i < values.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (values[i].text == values[j].text) at.at(i).fail("is listed twice");
  if (path == "integrator.rtol" || path == "integrator.step")
    at.fail("is set by 'tolerances' and 'steps' of the comparison; remove it here");
  if (path == "integrator.type") at.fail("is set by 'integrators' of the comparison; remove it here");
}

// Refuses a varied key that no integrator has, because varying it would have no effect.
void check_varied_options(const Comparison& c, const Config& config) {
  for (const auto& [path, values] : c.vary) {
    if (!path.starts_with("integrator.")) continue;
    const std::string key = path.substr(std::string("integrator.").size());
    std::vector<std::string> known;
    for (const auto& entry : c.integrators)
      for (const auto& k : Registry<IntegratorChoice>::entries().at(entry.type).keys) known.push_back(k.name);
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    config.at("vary").at(path).fail("none of the integrators has a key '" + key + "'" + did_you_mean(key, known));
  }
}

void refuse_unused(const Config& config, const std::string& name, const std::vector<double>& values,
                   const Comparison& c, const std::string& key) {
  const auto takes_key = [&](const IntegratorEntry& entry) { return has_key(entry.type, key); };
  if (values.empty() || std::any_of(c.integrators.begin(), c.integrators.end(), takes_key)) return;
  config.at(name).fail("no integrator has the key '" + key + "' that these values set; remove them");
}

void check_frames(const Comparison& c, const Config& at) {
  if (c.frames->count > c.samples)
    (at.has("count") ? at.at("count") : at)
        .fail(fmt::format("{} frames requested, but only {} samples are taken: reduce 'count' or raise 'samples'",
                          c.frames->count, c.samples));
}

void check_comparison(const Comparison& c, const Config& config) {
  if (c.scenes.empty()) config.at("scenes").fail("is empty; name at least one scene");
  if (c.integrators.empty()) config.at("integrators").fail("is empty; list integrators, or 'all'");
  if (c.tolerances.empty() && c.steps.empty()) config.fail("give 'tolerances', 'steps' or both");
  refuse_repeated(c.tolerances, config, "tolerances");
  refuse_repeated(c.steps, config, "steps");
  for (const auto& [path, values] : c.vary) check_varied(path, values, config.at("vary").at(path));
  if (c.frames) check_frames(c, config.at("frames"));
}

// Allows only keys that keep the body and its loads.
void check_reference_set(const ReferenceOptions& reference, const Config& config) {
  for (const auto& [path, value] : reference.set)
    if (!keeps_body(path))
      config.at("set").at(path).fail(
          "is not one of the keys that a reference may set: mesh.cells, mesh.order, mesh.refine, mesh.split, "
          "mesh.grading "
          "and mesh.file, which keep the body. Errors against another motion would be meaningless; set anything else "
          "in "
          "'scenes' or 'vary'");
  if (!reference.set.empty() && reference.kind == ReferenceKind::none)
    config.at("set").fail("has no effect with 'kind: none': remove one of them");
}

}  // namespace

bool keeps_body(const std::string& path) {
  static const std::set<std::string> keys{"cells", "order", "refine", "split", "grading", "file"};
  constexpr std::string_view kMesh = "mesh.";
  if (!path.starts_with(kMesh)) return false;
  const std::string key = path.substr(kMesh.size());
  return keys.contains(key.substr(0, key.find('.')));
}

const Spec<ReferenceOptions>& ReferenceOptions::spec() {
  static const auto s =
      Spec<ReferenceOptions>()
          .key("kind", &ReferenceOptions::kind,
               "automatic: the exact solution if there is one, otherwise computed. none: errors are not measured.")
          .key("integrator", &ReferenceOptions::integrator,
               "The integrator of the reference, as in a scene; default arkode_dirk at a thousandth of the smallest "
               "tolerance.")
          .key("check", &ReferenceOptions::check,
               "A second integrator, of another family. Its difference from the reference bounds the error of the "
               "reference; default cvode_bdf of order 5 at a thousandth of the smallest tolerance.")
          .key("set", &ReferenceOptions::set,
               "Mesh keys of the reference only, for a finer mesh: {mesh.cells: [80, 4, 2]}. Scenes that differ only "
               "in their meshes then share one reference, and errors at the probes include the mesh error.")
          .key("seconds", &ReferenceOptions::seconds, "Wall time limit of the reference and of the check.",
               {.unit = "s", .range = kLimitSeconds})
          .check(check_reference_set);
  return s;
}

const Spec<KeptFrames>& KeptFrames::spec() {
  static const auto s =
      Spec<KeptFrames>()
          .key("count", &KeptFrames::count, "Number of frames after the initial one, evenly spaced over the samples.",
               {.range = {1, 2000}})
          .key("fields", &KeptFrames::fields,
               "Node and cell fields of the frames, in addition to the displacement (see `orthodyn list fields`).");
  return s;
}

const Spec<Comparison>& Comparison::spec() {
  static const auto s =
      Spec<Comparison>()
          .key("title", &Comparison::title, "Heading of the report; default the file's name.")
          .key("description", &Comparison::description,
               "One or two sentences for the report: what is compared, and why.")
          .key("scenes", &Comparison::scenes, "Scene files, or sections {file, label, set}.", {.required = true})
          .key("integrators", &Comparison::integrators,
               "Names, 'all', or sections {type, label, any option of the integrator}.", {.fallback = "[all]"})
          .key("tolerances", &Comparison::tolerances, "Values of rtol for the adaptive methods.",
               {.range = {0, 1, true, true}})
          .key("steps", &Comparison::steps, "Step sizes for the fixed-step methods.", {.unit = "s", .range = kPositive})
          .key("vary", &Comparison::vary,
               "Values of further keys by path, in all combinations: {integrator.linear_solver: [klu, cholesky]}. Keys "
               "of 'integrator' make further methods, all others further scenes.")
          .key("quantities", &Comparison::quantities,
               "Names of quantities whose errors are measured too, relative to their largest magnitude over time (see "
               "`orthodyn list quantities`): [von_mises.largest, root.von_mises].")
          .key("frames", &Comparison::frames,
               "Write frames of each completed point and of its reference, for a 3D view side by side; {} for the "
               "defaults. An untimed run writes them, so timed runs are not affected.")
          .key("repeats", &Comparison::repeats, "Number of timed integrations per point.", {.range = {1, 100}})
          .key("samples", &Comparison::samples, "Number of evenly spaced times at which errors are measured.",
               {.range = {2, 2000}})
          .key("limits", &Comparison::limits, "Wall time and memory limits of each point.")
          .key("reference", &Comparison::reference, "The solution against which errors are measured.")
          .check(check_comparison);
  return s;
}

Comparison read_comparison(const Config& config) {
  refuse_other_kinds(config, InputFile::comparison);
  Comparison comparison = Comparison::spec().read(config);
  comparison.name = stem(config.file());
  if (comparison.title.empty()) comparison.title = comparison.name;
  if (config.has("tolerances")) comparison.tolerances_at = {config.at("tolerances").where()};
  if (config.has("steps")) comparison.steps_at = {config.at("steps").where()};
  comparison.integrators = expand_all(comparison.integrators);
  check_varied_options(comparison, config);
  refuse_unused(config, "tolerances", comparison.tolerances, comparison, "rtol");
  refuse_unused(config, "steps", comparison.steps, comparison, "step");
  refuse_equal_labels(comparison.scenes);
  refuse_equal_labels(comparison.integrators);
  return comparison;
}

}  // namespace orthodyn
