// Loads without effect, and gravity in another unit or direction.

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/core/errors.h"
#include "lib/core/golden_ratio_sample.h"
#include "lib/fem/time_functions/time_function.h"
#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn::input_checks {

namespace {

// Largest absolute value of a time function within the run, sampled between the times where it is not smooth.
double largest_within(const TimeFunction& factor, const CheckContext& context) {
  if (factor.is_harmonic()) return factor.peak(context.start(), context.end());
  if (context.is_static()) return std::abs(factor.value(context.end()));
  constexpr std::size_t kSamples = 20'000, kFewestInPiece = 50;  // resolves a pulse of some thousandths of the run
  std::vector<double> times = times_between(factor.kinks(), context.start(), context.end());
  times.insert(times.begin(), context.start());
  times.push_back(context.end());
  const auto samples = static_cast<int>(std::max(kSamples / (times.size() - 1), kFewestInPiece));
  double largest = 0;
  for (std::size_t piece = 0; piece + 1 < times.size(); ++piece)
    for (int k = 0; k <= samples; ++k) {
      const double t =
          k < samples ? times[piece] + (times[piece + 1] - times[piece]) * golden_ratio_sample(k) : times[piece + 1];
      largest = std::max(largest, std::abs(factor.value(t)));
    }
  return largest;
}

// True if the time function is nonzero at some time of the run. A pulse too short for the samples of largest_within()
// limits the steps, and counts as nonzero. So does a formula without a value, which the run reports.
bool acts_within(const TimeFunction& factor, const CheckContext& context) {
  try {
    if (largest_within(factor, context) > 0) return true;
    return !context.is_static() && !factor.step_limits(context.start(), context.end()).ends().empty();
  } catch (const ConfigError&) {
    return true;
  }
}

void check_time_functions(const CheckContext& context, Warnings& out) {
  if (!context.is_static() && !context.is_timed) return;
  visit_time_functions(context, [&](const Config& function) {
    const auto factor = Registry<TimeFunction>::read(function);
    if (acts_within(*factor, context)) return;
    const auto kinks = factor->kinks();
    const auto later = std::find_if(kinks.begin(), kinks.end(), [&](double t) { return t >= context.end(); });
    if (factor->is_harmonic()) {
      warn(out, function.where(), "the amplitude is 0: the load has no effect");
    } else if (context.is_static()) {
      warn(out, function.where(),
           "the factor is 0 at {:.4g} s (time.end), where statics evaluate it: the load or motion has no effect",
           context.end());
    } else if (later != kinks.end()) {
      warn(out, function.where(),
           "the factor is 0 during the whole run, from {:.4g} to {:.4g} s, and begins at {:.4g} s: is this time in ms, "
           "or is time.end too early?",
           context.start(), context.end(), *later);
    } else {
      warn(out, function.where(), "the factor is 0 during the whole run: the load or motion has no effect");
    }
  });
}

// True if the time function is zero at all times of the run, which check_time_functions() reports.
bool never_acts(const Config& section, const CheckContext& context) {
  if (!section.is_map() || !section.has("factor") || !is_time_function(section.at("factor"))) return false;
  return Registry<TimeFunction>::read(section.at("factor"))->peak(context.start(), context.end()) == 0;
}

// The name of a load with the key used in the input: "force on x1".
std::string name_of(const Config& section, const Term& term) {
  const std::string name = term.name();
  const auto on = name.find(" on ");
  return section.is_map() && section.has("force") && on != std::string::npos ? "force" + name.substr(on) : name;
}

// Warns of surface and point loads whose forces are zero or act on supported nodes only.
void add_idle_loads(const CheckContext& context, Warnings& out) {
  const FemModel& model = *context.built.model;
  const NodalExpansion nodal(model.parts(), context.built.initial.t, context.built.initial.q,
                             Vector::Zero(model.num_dofs()));
  const auto names = context.scene.force_terms();
  for (std::size_t k = 0; k < names.size(); ++k) {
    Traits traits;
    names[k]->declare(traits);
    const bool is_gravity = context.scene.gravity && k == 0;
    if (!traits.loaded && !is_gravity) continue;
    NodalVector f = NodalVector::Zero(3, nodal.x.cols());
    model.parts().loads[k]->add_peak_force(nodal.state(), context.end(), f);
    Vector free(model.num_dofs());
    model.parts().dofs->restrict_forces_to(f, free);
    const std::size_t first = context.scene.gravity ? 1 : 0, loads = first + context.scene.loads.size();
    const Config section = is_gravity  ? context.config.at("gravity")
                           : k < loads ? context.config.at("loads").at(k - first)
                                       : context.config.at("terms").at(k - loads);
    const std::string place = section.where(), name = name_of(section, *model.parts().loads[k]);
    if (f.isZero(0) && never_acts(section, context)) continue;
    if (f.isZero(0)) warn(out, place, "{} is zero and has no effect; give it a value", name);
    else if (free.isZero(0))
      warn(out, place,
           "{} acts on held nodes only: the supports take all of it, and nothing moves. Is it the wrong {}?", name,
           section.has("nearest") ? "point" : "surface");
  }
}

// Warns if the body is at rest and nothing moves it.
void add_idle_scene(const CheckContext& context, Warnings& out) {
  const Scene& scene = context.scene;
  const auto drives = [](const JointInput& joint) {
    return joint.motor || joint.load || (joint.spring && joint.spring->rest != 0);
  };
  if (std::any_of(scene.joints.begin(), scene.joints.end(), drives)) return;
  if (!context.is_timed_motion() || scene.gravity || !scene.loads.empty() || !scene.terms.empty() ||
      !scene.motions.empty() || scene.moisture || scene.temperature || scene.activation ||
      !context.built.initial.q.isZero(0) || !context.built.initial.v.isZero(0))
    return;
  warn(out, context.config.at("time").where(),
       "nothing acts on the body, and it is at rest at the start: it will not move. Add 'loads', 'gravity', 'motions' "
       "or 'initial' (`orthodyn modes` needs none of them)");
}

void check_gravity(const CheckContext& context, Warnings& out) {
  if (!context.scene.gravity) return;
  const Vec3 g = context.scene.gravity->g;
  const double size = g.norm();
  const auto near = [&](double x) { return std::abs(size / x - 1) < 0.01; };
  const std::string place = context.config.at("gravity").where();
  if (near(9810) || near(981))
    warn(out, place, "{:.5g} is the gravity of the earth in {}/s^2; orthodyn uses m/s^2: 9.81", size,
         near(981) ? "cm" : "mm");
  else if (size > 1000)
    warn(out, place, "{:.4g} m/s^2 is {:.0f} times the gravity of the earth: is the number in another unit?", size,
         size / 9.81);
  else if (near(9.81) && std::max(g[1], g[2]) > 0.99 * size)
    warn(out, place, "gravity points up, along +{}: use -{:.4g} to let bodies fall down", g[1] > g[2] ? 'y' : 'z',
         size);
}

}  // namespace

void check_load(const CheckContext& context, Warnings& out) {
  check_time_functions(context, out);
  add_idle_loads(context, out);
  add_idle_scene(context, out);
  check_gravity(context, out);
}

}  // namespace orthodyn::input_checks
