#include "lib/simulation/run/kinematics.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "lib/analysis/static_response.h"
#include "lib/core/spelling.h"

namespace orthodyn {

namespace {

constexpr double kErrorOverRtol = 10;         // allowed error over rtol: about what the local errors of a run add up to
constexpr double kDefaultError = 1e-3;        // allowed error if the integrator has no rtol
constexpr int kMaxReportedUnknowns = 200000;  // above it, no tangent is factorised for a report
constexpr double kOvershoot = 2;              // a suddenly applied load over its static response
constexpr double kClearExcess = 3;            // predicted over allowed error above which linear kinematics are rejected

double allowed_error(const Scene& scene) {
  if (scene.elasticity.linear_error) return *scene.elasticity.linear_error;
  if (scene.integrator)
    if (const auto rtol = scene.integrator->settings().rtol) return kErrorOverRtol * *rtol;
  return kDefaultError;
}

bool is_open(const Scene& scene, const Region& region) {
  return elasticity_of(scene, region).kinematics == Kinematics::automatic;
}

std::vector<std::string> open_regions(const Scene& scene) {
  std::vector<std::string> names;
  for (const auto& [name, region] : scene.regions)
    if (is_open(scene, region)) names.push_back(name);
  return names;
}

double end_of_motion(const Scene& scene) {
  return scene.is_static() ? std::numeric_limits<double>::infinity() : scene.time.end;
}

Scene with_linear_regions(Scene scene) {
  for (auto& [name, region] : scene.regions)
    if (is_open(scene, region)) region.kinematics = Kinematics::linear;
  return scene;
}

// The entries `names` of the scene's regions that have elements in the model.
std::vector<LinearRegion> linear_regions(const Scene& scene, const std::vector<std::string>& names,
                                         const FemModel& model) {
  std::vector<LinearRegion> regions;
  for (const auto& name : names) {
    Linearity::Terms terms;
    for (std::size_t k = 0; k < model.parts().elastic.size(); ++k)
      if (entry_of(scene, model.parts().elastic[k]->definition().mesh_region).first == name) terms.push_back(k);
    if (!terms.empty()) regions.push_back({name, std::move(terms)});
  }
  return regions;
}

bool says_auto(const Config& section) {
  return section.has("kinematics") && !section.at("kinematics").is_null() && section.at("kinematics").text() == "auto";
}

// The key to name in errors: `elasticity.kinematics` or `regions`.
Config auto_key(const Config& scene) {
  const Config elasticity = scene.at("elasticity");
  return says_auto(elasticity) ? elasticity.at("kinematics") : scene.at("regions");
}

// The type of an integrator that supports linear kinematics only; else "".
std::string only_linear_integrator(const Config& config, const Scene& scene) {
  const bool is_only =
      scene.analysis == Analysis::dynamic && scene.integrator && scene.integrator->needs_linear_model();
  return is_only ? config.at("integrator").at("type").text() : "";
}

// Makes only `regions` corotational if each has its own entry in the document, else all. Returns the decision:
// "corotational in arm: why".
std::string make_regions_corotational(Config& config, const std::vector<std::string>& regions, const std::string& why) {
  const auto is_written = [&](const std::string& name) {
    return config.has("regions") && config.at("regions").has(name);
  };
  if (regions.size() == open_regions(read_scene(config)).size() ||
      !std::all_of(regions.begin(), regions.end(), is_written)) {
    make_corotational(config);
    return "corotational: " + why;
  }
  for (const auto& name : regions) {
    Config region = config.at("regions").at(name);
    region.set("kinematics", std::string("corotational"));
  }
  return fmt::format("corotational in {}: {}", join(regions), why);
}

// A watch if linear kinematics are accepted; else the regions for which they are rejected, and why.
struct Trial {
  std::vector<std::string> rejected = {};
  std::string why = {};
  std::unique_ptr<LinearityWatch> watch = {};
};

Trial try_linear(const Scene& scene, const std::vector<std::string>& open, const BuiltScene& built, double allowed,
                 bool predict, const std::string& only_linear) {
  const bool is_static = scene.is_static();
  try {
    auto watch = std::make_unique<LinearityWatch>(*built.model, linear_regions(scene, open, *built.model),
                                                  scene.time.start, end_of_motion(scene), allowed, only_linear);
    watch->error_at(scene.time.start, Vector::Zero(built.model->num_dofs()));  // throws if it cannot be computed
    if (!predict) return {.watch = std::move(watch)};
    const StaticResponse response = static_response(*built.model, built.initial, scene.time.end);
    if (!response.exists()) return {.watch = std::move(watch)};
    const double reached = is_static ? 1 : kOvershoot * load_duration_factor(built.model->space(), response);
    const Vector q = built.initial.q + reached * response.displacement;
    const LinearityError error = watch->error_at(scene.time.end, q);
    if (error.displacement <= kClearExcess * allowed) return {.watch = std::move(watch)};
    return {.rejected = watch->corotational_regions(scene.time.end, q),
            .why = error.unstable ? kBucklesBelowLoads
                                  : fmt::format("linear kinematics would be off by {}{}, where {:.2g} is allowed",
                                                linearity_error_text(error.displacement),
                                                is_static ? "" : " at the displacement that the loads reach", allowed)};
  } catch (const RunError& e) {
    return {.rejected = open, .why = e.what()};
  }
}

}  // namespace

bool leaves_kinematics_open(const Scene& scene) { return !open_regions(scene).empty(); }

namespace {

void replace_auto(Config& config, const std::string& kinematics) {
  if (config.has("elasticity")) {
    Config elasticity = config.at("elasticity");
    if (says_auto(elasticity)) elasticity.set("kinematics", kinematics);
    if (elasticity.has("linear_error")) elasticity.set("linear_error", nullptr);
  }
  if (!config.has("regions")) return;
  for (const auto& name : config.at("regions").keys())
    if (Config region = config.at("regions").at(name); says_auto(region)) region.set("kinematics", kinematics);
}

}  // namespace

void make_corotational(Config& config) { replace_auto(config, "corotational"); }

Config with_chosen_kinematics(const Config& config) {
  Config copy = config.copy();
  replace_auto(copy, "linear");
  return copy;
}

void run_with_kinematics_restarts(const Config& scene, const KinematicsAttempt& attempt) {
  Config now = scene.copy();
  KinematicsChoice choice;
  while (const auto restart = attempt(now.copy(), choice.reason))
    choice.add_reason(make_regions_corotational(now, restart->regions, restart->why));
}

bool has_linear_region(const Scene& scene) {
  return std::any_of(scene.regions.begin(), scene.regions.end(), [&](const auto& entry) {
    return elasticity_of(scene, entry.second).kinematics == Kinematics::linear;
  });
}

std::unique_ptr<LinearityWatch> reporting_watch(const Scene& scene, const FemModel& model) {
  if (model.num_dofs() > kMaxReportedUnknowns) return nullptr;
  std::vector<std::string> names;
  for (const auto& [name, region] : scene.regions)
    if (elasticity_of(scene, region).kinematics == Kinematics::linear) names.push_back(name);
  auto regions = linear_regions(scene, names, model);
  if (regions.empty()) return nullptr;
  constexpr double kAny = std::numeric_limits<double>::infinity();
  return std::make_unique<LinearityWatch>(model, std::move(regions), scene.time.start, end_of_motion(scene), kAny);
}

ChosenKinematics choose_kinematics(Config& config, Scene& scene, bool resumes_linear) {
  const double allowed = allowed_error(scene);
  const std::string only_linear = only_linear_integrator(config, scene);
  KinematicsChoice choice;
  // Linear kinematics have no stress stiffness, which buckling and vibrations about a loaded state need.
  if (scene.analysis == Analysis::buckling || scene.analysis == Analysis::harmonic) {
    make_corotational(config);
    scene = read_scene(config);
    return {std::move(choice), build(scene), nullptr};
  }
  for (auto open = open_regions(scene); !open.empty(); open = open_regions(scene)) {
    const Scene linear = with_linear_regions(scene);
    BuiltScene built = build(linear);
    if (linear_regions(linear, open, *built.model).empty()) break;  // no region with `auto` has elements
    Trial trial = try_linear(linear, open, built, allowed, !resumes_linear, only_linear);
    if (trial.watch) {
      config.set("elasticity.linear_error", allowed);
      scene = linear;
      choice.linear = choice.reason.empty();
      return {std::move(choice), std::move(built), std::move(trial.watch)};
    }
    if (!only_linear.empty())
      auto_key(config).fail(trial.why + ", and " + other_integrator(only_linear) +
                            ", or raise elasticity.linear_error");
    choice.add_reason(make_regions_corotational(config, trial.rejected, trial.why));
    scene = read_scene(config);
  }
  return {std::move(choice), build(scene), nullptr};
}

}  // namespace orthodyn
