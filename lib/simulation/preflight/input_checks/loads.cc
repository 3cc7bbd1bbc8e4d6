// Loads that do nothing, and gravity in another unit or the other way.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/core/errors.h"
#include "lib/core/golden_ratio_sample.h"
#include "lib/fem/time_functions/time_function.h"
#include "lib/simulation/preflight/input_checks/subject.h"

namespace orthodyn::input_checks {

namespace {

// The largest size of a factor within the run: sampled between the times where it is not smooth.
double largest_within(const TimeFunction& factor, const Subject& subject) {
  if (subject.is_static()) return std::abs(factor.value(subject.end()));
  constexpr std::size_t kSamples = 20'000, kFewestInPiece = 50;  // a window of some thousandths of the run is seen
  std::vector<double> times = times_between(factor.kinks(), subject.start(), subject.end());
  times.insert(times.begin(), subject.start());
  times.push_back(subject.end());
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

// Steps are limited by a pulse that is too short for these samples: of that the run tells. A formula may have no value
// somewhere: the run will tell, if it comes so far.
bool acts_within(const TimeFunction& factor, const Subject& subject) {
  try {
    if (largest_within(factor, subject) > 0) return true;
    return !subject.is_static() && !factor.step_limits(subject.start(), subject.end()).ends().empty();
  } catch (const ConfigError&) {
    return true;
  }
}

void check_factor(const Subject& subject, const Config& section, Warnings& out) {
  visit_keys(section, "factor", [&](const Config& given) {
    if (!names_a_factor(given)) return;
    const auto factor = Registry<TimeFunction>::read(given);
    if (acts_within(*factor, subject)) return;
    const auto kinks = factor->kinks();
    const auto later = std::find_if(kinks.begin(), kinks.end(), [&](double t) { return t >= subject.end(); });
    if (subject.is_static()) {
      out.push_back(
          fmt::format("{}: it is 0 at the time of the statics, {:.4g} s (time.end): what it multiplies does "
                      "not act",
                      given.where(), subject.end()));
    } else if (later != kinks.end()) {
      out.push_back(
          fmt::format("{}: it is 0 during the whole run, from {:.4g} to {:.4g} s, and begins at {:.4g} s: is "
                      "that in ms, or time.end too early?",
                      given.where(), subject.start(), subject.end(), *later));
    } else {
      out.push_back(fmt::format("{}: it is 0 during the whole run: what it multiplies never acts", given.where()));
    }
  });
}

// Of its factor the rules above tell.
bool never_acts(const Config& given, const Subject& subject) {
  if (!given.is_map() || !given.has("factor") || !names_a_factor(given.at("factor"))) return false;
  return Registry<TimeFunction>::read(given.at("factor"))->peak(subject.start(), subject.end()) == 0;
}

// That of a load by the key that the user gave: "force on x1".
std::string name_of(const Config& given, const Term& term) {
  const std::string name = term.name();
  const auto on = name.find(" on ");
  return given.is_map() && given.has("force") && on != std::string::npos ? "force" + name.substr(on) : name;
}

// Of loads on surfaces and of point loads: forces on all nodes that are zero, or that held nodes take alone.
void add_idle_loads(const Subject& subject, Warnings& out) {
  const FemModel& model = *subject.built.model;
  const NodalExpansion nodal(model.parts(), subject.built.initial.t, subject.built.initial.q,
                             Vector::Zero(model.num_dofs()));
  const auto names = subject.scene.force_terms();
  for (std::size_t k = 0; k < names.size(); ++k) {
    Traits traits;
    names[k]->declare(traits);
    const bool is_gravity = subject.scene.gravity && k == 0;
    if (!traits.loaded && !is_gravity) continue;
    NodalVector f = NodalVector::Zero(3, nodal.x.cols());
    model.parts().loads[k]->add_peak_force(nodal.state(), subject.end(), f);
    Vector free(model.num_dofs());
    model.parts().dofs->restrict_to(f, free);
    const std::size_t first = subject.scene.gravity ? 1 : 0, loads = first + subject.scene.loads.size();
    const Config given = is_gravity  ? subject.config.at("gravity")
                         : k < loads ? subject.config.at("loads").at(k - first)
                                     : subject.config.at("terms").at(k - loads);
    const std::string place = given.where(), name = name_of(given, *model.parts().loads[k]);
    if (f.isZero(0) && never_acts(given, subject)) continue;
    if (f.isZero(0)) out.push_back(fmt::format("{}: {} is zero: it does nothing; give it a value", place, name));
    else if (free.isZero(0))
      out.push_back(
          fmt::format("{}: {} acts on held nodes only: the supports take all of it, and nothing moves. Is it "
                      "the wrong {}?",
                      place, name, given.has("nearest") ? "point" : "surface"));
  }
}

// It is at rest, and nothing is there to change that.
void add_idle_scene(const Subject& subject, Warnings& out) {
  const Scene& scene = subject.scene;
  if (!subject.moves() || scene.gravity || !scene.loads.empty() || !scene.terms.empty() || !scene.motions.empty() ||
      !subject.built.initial.q.isZero(0) || !subject.built.initial.v.isZero(0))
    return;
  out.push_back(
      fmt::format("{}: nothing acts on the body, and it is at rest at the start: it will not move. Give it "
                  "'loads', 'gravity', 'motions' or 'initial'",
                  subject.config.at("time").where()));
}

void check_gravity(const Subject& subject, Warnings& out) {
  if (!subject.scene.gravity) return;
  const Vec3 g = subject.scene.gravity->g;
  const double size = g.norm();
  const auto near = [&](double x) { return std::abs(size / x - 1) < 0.01; };
  const std::string place = subject.config.at("gravity").where();
  if (near(9810) || near(981))
    out.push_back(fmt::format("{}: {:.5g} m/s^2 is that of the earth in {}/s^2: orthodyn computes in m/s^2, 9.81",
                              place, size, near(981) ? "cm" : "mm"));
  else if (size > 1000)
    out.push_back(fmt::format("{}: {:.4g} m/s^2 is {:.0f} times that of the earth: is its unit another one?", place,
                              size, size / 9.81));
  else if (near(9.81) && std::max(g[1], g[2]) > 0.99 * size)
    out.push_back(fmt::format("{}: it points up, along +{}: with -{:.4g} things fall down", place,
                              g[1] > g[2] ? 'y' : 'z', size));
}

}  // namespace

void check_load(const Subject& subject, Warnings& out) {
  for (const char* section : {"loads", "terms", "motions"})
    if (subject.config.has(section) && (subject.is_static() || subject.is_timed))
      check_factor(subject, subject.config.at(section), out);
  add_idle_loads(subject, out);
  add_idle_scene(subject, out);
  check_gravity(subject, out);
}

}  // namespace orthodyn::input_checks
