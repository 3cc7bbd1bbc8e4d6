#include "tests/fuzz/input_check.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <typeinfo>

#include "lib/analysis/strain_limits.h"
#include "lib/simulation/run/scene_file.h"
#include "lib/simulation/run/setup.h"
#include "lib/simulation/statics/static_problem.h"
#include "lib/study/compare/comparison_design.h"
#include "lib/study/stability/stability.h"
#include "lib/study/sweep/sweep_design.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

constexpr double kMostPoints = 30;  // larger studies are not expanded, because each point reads a scene

void check_materials(const Scene& scene) {
  for (const auto& [name, material] : scene.materials) strain_limits(material->stiffness());
}

void check_scene(Config scene) {
  refuse_other_kinds(scene, InputFile::scene);
  if (scene.is_map() && !scene.has("time") && !scene.has("analysis")) scene.set("time.end", 1.0);
  const Setup setup = set_up(scene);
  const FemModel& model = *setup.built.model;
  check_materials(setup.scene);
  for (const auto& term : model.parts().elastic) term->description();
  for (const auto& term : model.parts().loads) term->description();
  setup.config.dump_for("");
  if (!setup.integrator) {
    static_problem(setup.scene, setup.built);
    return;
  }
  setup.integrator->start(setup.built.initial);
  model.frequency_bound();
  model.breakpoints(setup.scene.time.start, setup.scene.time.end);
  setup.integrator->decisions();
}

void check_sweep(const Config& config) {
  const Sweep sweep = read_sweep(config);
  double points = sweep.combine == Combine::latin_hypercube ? sweep.samples.value_or(50) : 1;
  if (sweep.combine == Combine::cartesian)
    for (const auto& v : sweep.vary) points *= static_cast<double>(v.values.size());
  if (sweep.combine == Combine::zip) points = static_cast<double>(sweep.vary.front().values.size());
  if (points <= kMostPoints) study::sweep::expand(sweep);
}

void check_comparison(const Config& config) {
  Comparison comparison = read_comparison(config);
  // Reduces the comparison to one run of each integrator, with one scene.
  comparison.tolerances.resize(std::min<std::size_t>(comparison.tolerances.size(), 1));
  comparison.steps.resize(std::min<std::size_t>(comparison.steps.size(), 1));
  comparison.scenes.erase(comparison.scenes.begin() + 1, comparison.scenes.end());
  for (auto& [path, values] : comparison.vary) values.resize(1);
  study::compare::expand(comparison);
}

void check_stability(const Config& config) {
  Stability stability = read_stability(config);
  const auto some = [](auto& list, std::size_t most) { list.resize(std::min(list.size(), most)); };
  some(stability.cases, 3);
  some(stability.integrators, 4);
  some(stability.variants, 2);
  stability_runs(stability);
}

void check_input(const InputFileText& input) {
  const Config config = Config::from_text(input.text, std::string(ORTHODYN_SOURCE_DIR) + "/" + input.path);
  const std::string folder = fs::path(input.path).parent_path().filename().string();
  if (folder == "comparisons") return check_comparison(config);
  if (folder == "sweeps") return check_sweep(config);
  if (folder == "stability") return check_stability(config);
  check_scene(config.copy());
}

}  // namespace

std::vector<InputFileText> shipped_inputs() {
  const fs::path root(ORTHODYN_SOURCE_DIR);
  std::vector<InputFileText> all;
  for (const auto& entry : fs::recursive_directory_iterator(root / "configs")) {
    if (entry.path().extension() != ".yaml") continue;
    const std::string stem = entry.path().stem().string();
    if (stem == "guitar_top" || stem == "braced_soundboard") continue;  // their modes take a minute
    std::ifstream file(entry.path(), std::ios::binary);
    all.push_back({entry.path().lexically_relative(root).string(), {std::istreambuf_iterator<char>(file), {}}});
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return all;
}

void limit_memory_of_meshes() {
  rlimit limit{};
  getrlimit(RLIMIT_RSS, &limit);
  limit.rlim_cur = 10'000'000;
  setrlimit(RLIMIT_RSS, &limit);
}

InputVerdict judge(const InputFileText& input) {
  try {
    check_input(input);
    return {};
  } catch (const ConfigError& e) {
    return {e.place().empty() ? Verdict::bug : Verdict::refused, e.what()};
  } catch (const RunError& e) {  // of modes, which the limit of memory leaves to an iterative solver
    return {std::string(e.what()).starts_with("modes: ") ? Verdict::refused : Verdict::bug, e.what()};
  } catch (const std::exception& e) {
    return {Verdict::bug, std::string(typeid(e).name()) + ": " + e.what()};
  }
}

}  // namespace orthodyn
