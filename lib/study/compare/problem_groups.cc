#include "lib/study/compare/problem_groups.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "lib/study/inputs/labels.h"

namespace orthodyn::study::compare {

namespace {

// The changes of a problem, divided into those of the mesh and all others.
struct Split {
  Assignments others;
  std::string mesh_words, other_words;
};

Split split_of(const SceneEntry& scene, const Variant& variant) {
  Split split;
  for (const auto* set : {&scene.set, &variant.set})
    for (const auto& [path, value] : *set)
      if (!keeps_body(path)) split.others.emplace_back(path, value);
  for (const auto& [path, value] : variant.set)
    (keeps_body(path) ? split.mesh_words : split.other_words) += words_of(path, value);
  return split;
}

// Problems with equal keys share a reference.
std::string key_of(const SceneEntry& scene, const Assignments& others) {
  std::string key = scene.file.path;
  for (const auto& [path, value] : others) key += "\n" + path + ": " + value.text;
  return key;
}

// The scene of a reference. Its mesh is that of the scene's file, with the changes of `reference.set`.
SceneVariant reference_of(const Comparison& comparison, const SceneVariant& problem, const Split& split) {
  SceneVariant reference{problem.file, problem.text, split.others};
  reference.set.insert(reference.set.end(), comparison.reference.set.begin(), comparison.reference.set.end());
  return reference;
}

// Throws ConfigError if the scene has no probes: solutions on different meshes are compared at probes.
void require_probes(const Comparison& comparison, const SceneEntry& scene, const SceneVariant& variant) {
  Config config = Config::from_text(variant.text, variant.file);
  assign(config, variant.set);
  if (config.has("output") && config.at("output").is_map() && config.at("output").has("probes") &&
      !config.at("output").at("probes").keys().empty())
    return;
  comparison.reference.set.front().second.origin.fail(
      "a reference with its own mesh needs probes, at which errors are measured; the scene " + scene.label +
      " has none: add 'output: {probes: {tip: {at: [1, 0, 0]}}}' to it, or 'output.probes.tip.at: [1, 0, 0]' to its "
      "'set'");
}

// Labels the groups. Labels the members of a group by what distinguishes them: scene entries and changes of the mesh.
void name_members(const Comparison& comparison, const std::vector<std::size_t>& entry_of, Design& design) {
  for (std::size_t g = 0; g < design.groups.size(); ++g) {
    std::set<std::size_t> entries;
    for (std::size_t p = 0; p < design.problems.size(); ++p)
      if (design.problems[p].group == g) entries.insert(entry_of[p]);
    const SceneEntry& first = comparison.scenes[*entries.begin()];
    const std::string others = design.groups[g].label;
    design.groups[g].label = (entries.size() > 1 ? stem(first.file.path) : first.label) + others;
    for (std::size_t p = 0; p < design.problems.size(); ++p) {
      Problem& problem = design.problems[p];
      if (problem.group != g) continue;
      if (entries.size() > 1) problem.mesh = comparison.scenes[entry_of[p]].label + problem.mesh;
      else problem.mesh.erase(0, 2);  // ", "
      if (problem.mesh.empty()) problem.mesh = problem.label;
    }
  }
}

// Gives each scene its own reference.
void group_individually(Design& design) {
  for (auto& problem : design.problems) {
    problem.group = design.groups.size();
    problem.mesh = problem.label;
    design.groups.push_back({problem.id, problem.label, problem.scene});
  }
}

}  // namespace

std::string last_key(const std::string& path) {
  const auto dot = path.rfind('.');
  return dot == std::string::npos ? path : path.substr(dot + 1);
}

std::string words_of(const std::string& path, const YamlText& value) {
  return ", " + last_key(path) + " " + value.text;
}

std::string identifier(const std::string& label) {
  std::string id;
  for (const char c : label) {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.') id += c;
    else if (!id.empty() && id.back() != '-') id += '-';
  }
  while (id.ends_with('-')) id.pop_back();
  return id.empty() ? "unnamed" : id;
}

void add_problems(const Comparison& comparison, const std::vector<Variant>& variants, Design& design) {
  design.across_meshes = !comparison.reference.set.empty();
  std::vector<std::string> keys;
  std::vector<std::size_t> entry_of;
  for (std::size_t e = 0; e < comparison.scenes.size(); ++e) {
    const SceneEntry& scene = comparison.scenes[e];
    const std::string text = read_scene_text(scene.file);
    for (const auto& variant : variants) {
      SceneVariant changed{scene.file.path, text, scene.set};
      changed.set.insert(changed.set.end(), variant.set.begin(), variant.set.end());
      Problem problem{"", scene.label + variant.words, changed, 0, ""};
      if (design.across_meshes) {
        require_probes(comparison, scene, changed);
        const Split split = split_of(scene, variant);
        const std::string key = key_of(scene, split.others);
        problem.group = static_cast<std::size_t>(std::find(keys.begin(), keys.end(), key) - keys.begin());
        problem.mesh = split.mesh_words;
        if (problem.group == keys.size()) {
          keys.push_back(key);
          design.groups.push_back({"", split.other_words, reference_of(comparison, changed, split)});
        }
      }
      design.problems.push_back(std::move(problem));
      entry_of.push_back(e);
    }
  }
  identify(design.problems);
  if (!design.across_meshes) return group_individually(design);
  name_members(comparison, entry_of, design);
  identify(design.groups);
}

}  // namespace orthodyn::study::compare
