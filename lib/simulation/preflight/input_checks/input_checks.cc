#include "lib/simulation/preflight/input_checks/input_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/golden_ratio_sample.h"
#include "lib/fem/time_functions/time_function.h"
#include "lib/scene/region.h"
#include "lib/simulation/preflight/input_checks/subject.h"
#include "lib/simulation/run/kinematics.h"

namespace orthodyn {

namespace input_checks {

Subject::Subject(const Config& input, const Scene& given, const BuiltScene& made, bool timed)
    : config(input),
      scene(given),
      built(made),
      is_timed(timed),
      box(bounding_box(made.model->parts().mesh)),
      extent(box.size().maxCoeff()) {
  for (const auto& term : built.model->parts().elastic)
    wave = std::max(wave, fastest_wave(material_in(scene, term->region())));
}

std::optional<Config> value_at(const Config& config, const std::vector<std::string>& path) {
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

bool names_a_factor(const Config& section) {
  return section.is_map() && section.has("type") && section.at("type").is_scalar() &&
         Registry<TimeFunction>::entries().contains(section.at("type").text());
}

void visit_times(const Subject& subject, const std::function<void(double)>& visit) {
  constexpr int kSamples = 50;
  std::vector<double> times{subject.start()}, ends = subject.built.model->breakpoints(subject.start(), subject.end());
  ends.push_back(subject.end());
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

std::string shown_factor(double x) {
  if (std::abs(x) < 10 || std::abs(x) >= 1e6) return fmt::format("{:.2g}", x);
  std::string digits = fmt::format("{:.0f}", x);
  if (digits.size() > 3) digits.insert(digits.size() - 3, ",");
  return digits;
}

double fastest_wave(const Material& material) {
  return std::sqrt(voigt(material.stiffness()).diagonal().maxCoeff() / material.density());
}

double distance(const Vec3& point, const Box& box) {
  return (point - point.cwiseMax(box.min).cwiseMin(box.max)).norm();
}

}  // namespace input_checks

Warnings check_inputs(const Config& config, const Scene& scene, const BuiltScene& built, bool is_timed) {
  const input_checks::Subject subject(config, scene, built, is_timed);
  Warnings out;
  for (const auto add :
       {input_checks::check_material, input_checks::check_place, input_checks::check_load, input_checks::check_time,
        input_checks::check_motion, input_checks::check_freedom, input_checks::check_turning,
        input_checks::check_damping, input_checks::check_event, input_checks::check_setting})
    add(subject, out);
  out.insert(out.end(), config.warnings().begin(), config.warnings().end());
  return out;
}

Warnings slips_of(const Config& given) {
  Config config = given.resolving();
  Warnings out;
  try {
    Scene scene = read_scene(config);
    if (leaves_kinematics_open(scene)) {
      make_corotational(config);
      scene = read_scene(config);
    }
    const BuiltScene built = build(scene);
    out = check_inputs(config, scene, built);
    if (built.model->num_dofs() > kMostUnknownsOfResponse) return out;
    const StaticResponse statics = static_response(*built.model, built.initial, scene.time.end);
    for (auto& slip : check_response(config, scene, built, statics)) out.push_back(std::move(slip));
  } catch (const ConfigError&) {  // what refuses the scene is told where it is run
  } catch (const RunError&) {
  }
  return out;
}

}  // namespace orthodyn
