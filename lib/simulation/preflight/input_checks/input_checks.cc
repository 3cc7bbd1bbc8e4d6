#include "lib/simulation/preflight/input_checks/input_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/golden_ratio_sample.h"
#include "lib/fem/time_functions/time_function.h"
#include "lib/simulation/preflight/input_checks/check_context.h"
#include "lib/simulation/run/kinematics.h"

namespace orthodyn {

namespace input_checks {

CheckContext::CheckContext(const Config& resolved, const Scene& its_scene, const BuiltScene& its_model, bool timed)
    : config(resolved),
      scene(its_scene),
      built(its_model),
      is_timed(timed),
      box(bounding_box(its_model.model->parts().mesh)),
      extent(box.size().maxCoeff()) {
  const FemModel::Parts& parts = built.model->parts();
  for (std::size_t k = 0; k < parts.elastic.size(); ++k)
    wave_speed = std::max(wave_speed, fastest_wave(parts.elastic[k]->stiffness(), parts.densities[k]));
  constexpr double kOfSteel = 6e3;  // m/s; checks of rigid bodies need some stiff material
  if (parts.elastic.empty()) wave_speed = kOfSteel;
}

std::optional<Config> find_value(const Config& config, const std::vector<std::string>& path) {
  Config here = config;
  for (const auto& key : path) {
    if (!here.has(key)) return {};
    here = here.at(key);
  }
  if (here.is_null()) return {};
  return here;
}

void visit_keys(const Config& config, const std::string& key, const std::function<void(const Config&)>& visit) {
  if (config.is_sequence())
    for (std::size_t i = 0; i < config.size(); ++i) visit_keys(config.at(i), key, visit);
  if (!config.is_map()) return;
  for (const auto& name : config.keys()) {
    if (config.at(name).is_null()) continue;
    if (name == key) visit(config.at(name));
    else visit_keys(config.at(name), key, visit);
  }
}

bool is_time_function(const Config& section) {
  return section.is_map() && section.has("type") && section.at("type").is_scalar() &&
         Registry<TimeFunction>::entries().contains(section.at("type").text());
}

void visit_time_functions(const CheckContext& context, const std::function<void(const Config&)>& visit) {
  const auto visit_below = [&](const Config& section) {
    visit_keys(section, "factor", [&](const Config& function) {
      if (is_time_function(function)) visit(function);
    });
  };
  for (const char* section : {"loads", "terms", "motions"})
    if (context.config.has(section)) visit_below(context.config.at(section));
  for (std::size_t k = 0; k < context.scene.joints.size(); ++k)
    if (context.scene.joints[k].load) visit_below(context.config.at("joints").at(k).at("load"));
}

void visit_times(const CheckContext& context, const std::function<void(double)>& visit) {
  constexpr int kSamples = 50;
  std::vector<double> times{context.start()}, ends = context.built.model->breakpoints(context.start(), context.end());
  ends.push_back(context.end());
  for (const double end : ends) {
    const double begin = times.back();
    for (int k = 0; k < kSamples; ++k) times.push_back(begin + (end - begin) * golden_ratio_sample(k));
    std::sort(times.end() - kSamples, times.end());
    times.push_back(end);
  }
  try {
    for (const double t : times) visit(t);
  } catch (const ConfigError&) {
  }
}

NodalVector load_forces(const FemModel::Parts& parts, const NodalExpansion& nodal) {
  NodalVector f = NodalVector::Zero(3, nodal.x.cols());
  for (const auto& load : parts.loads)
    if (load->energy_kind() != EnergyKind::gravitational) load->add_force(nodal.state(), f);
  return f;
}

std::string factor_text(double x) {
  if (std::abs(x) < 10 || std::abs(x) >= 1e6) return fmt::format("{:.2g}", x);
  std::string digits = fmt::format("{:.0f}", x);
  if (digits.size() > 3) digits.insert(digits.size() - 3, ",");
  return digits;
}

double fastest_wave(const Mat6& stiffness, double density) {
  return std::sqrt(stiffness.diagonal().maxCoeff() / density);
}

double distance(const Vec3& point, const Box& box) {
  return (point - point.cwiseMax(box.min).cwiseMin(box.max)).norm();
}

}  // namespace input_checks

Warnings check_inputs(const Config& config, const Scene& scene, const BuiltScene& built, bool is_timed) {
  const input_checks::CheckContext context(config, scene, built, is_timed);
  Warnings out;
  for (const auto add :
       {input_checks::check_material, input_checks::check_place, input_checks::check_load, input_checks::check_time,
        input_checks::check_motion, input_checks::check_freedom, input_checks::check_hourglass,
        input_checks::check_change, input_checks::check_layers, input_checks::check_locking, input_checks::check_fibres,
        input_checks::check_friction, input_checks::check_relaxation, input_checks::check_turning,
        input_checks::check_damping, input_checks::check_event, input_checks::check_setting})
    add(context, out);
  return out;
}

Warnings scene_warnings(const Config& input, bool is_timed) {
  Config config = input.resolving();
  Warnings out;
  try {
    Scene scene = read_scene(config);
    if (leaves_kinematics_open(scene)) {
      make_corotational(config);
      scene = read_scene(config);
    }
    const BuiltScene built = build(scene);
    out = config.warnings();
    for (auto& warning : check_inputs(config, scene, built, is_timed)) out.push_back(std::move(warning));
    if (!is_timed || built.model->num_dofs() > kMaxUnknownsOfResponse) return out;
    const StaticResponse statics = static_response(*built.model, built.initial, scene.time.end);
    for (auto& warning : check_response(config, scene, built, statics)) out.push_back(std::move(warning));
  } catch (const ConfigError&) {  // reported where the scene is run
  } catch (const RunError&) {
  }
  return out;
}

}  // namespace orthodyn
