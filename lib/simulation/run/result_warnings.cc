#include "lib/simulation/run/result_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/simulation/error_estimate/estimated_error.h"

namespace orthodyn {

namespace {

constexpr double kMuchDrift = 0.01;  // of the largest energy
constexpr double kMuchError = 0.05;  // of the largest displacement
// Of the largest load: what is less is round-off of the internal forces of slender bodies, whose displacements are
// right.
constexpr double kLargeResidual = 1e-6;

// From two states alone the elastic energy between them is not known: the largest energy may be larger.
std::string drift_sentence(const EnergySummary& energy) {
  return fmt::format(
      "the energy balance drifts by {:.2g} of the largest energy{}: energy was made or lost by the integration, or "
      "what fast vibrations dissipate was not resolved. Run it with --estimate-error, which tells how far off "
      "the motion "
      "is, or with a smaller integrator.rtol or integrator.step",
      energy.relative_drift,
      energy.states > 2 ? ""
                        : ", of which only the start and the end were looked at (output.energy_times: steps looks at "
                          "every step; the share may then be smaller)");
}

// That which `auto` has taken, too.
std::string method_of(const MotionResult& motion) {
  for (const auto& [key, value] : motion.decisions)
    if (key == "method") return value;
  return motion.integrator;
}

std::string accumulation_sentence(const MotionResult& motion) {
  return fmt::format(
      "the errors of {} steps, each within its tolerance, may have added up to {:.2g} of the largest motion: most "
      "often "
      "it lags behind or runs ahead. Take smaller steps (integrator.rtol, integrator.step), {}, or see with "
      "--estimate-error how far off "
      "it is",
      motion.effort.statistics.steps, motion.accumulated->error,
      method_of(motion) == "arkode_dirk" ? "a smaller integrator.h_max" : "integrator.type: arkode_dirk");
}

std::string mesh_sentence(const ModelSummary& model, double error) {
  return fmt::format(
      "the mesh is coarse for this motion: of the elastic energy about {:.2g} is its error. Deflections are too small "
      "and frequencies too high. {}, and compare (frames with the field mesh_error show where)",
      error, finer_mesh(model.order));
}

constexpr const char* kBuckles =
    "the body buckles below these loads, which linear kinematics do not show. Take elasticity.kinematics: auto, or "
    "corotational; analysis: buckling tells the load factors";

constexpr const char* kUnsymmetricLoads =
    "the stiffness of a pressure that follows a surface with a free edge is unsymmetric; buckling takes its symmetric "
    "part, so that load factors may be off and instability by growing vibrations (flutter) is not found. analysis: "
    "static "
    "follows the path with all of it";

std::string linearity_sentence(double error) {
  constexpr const char* kRemedy = "Take elasticity.kinematics: auto, or corotational";
  if (!std::isfinite(error))
    return fmt::format(
        "how far linear kinematics are off could not be estimated, for rotations or stretches are too "
        "large for them. {}",
        kRemedy);
  return fmt::format(
      "linear kinematics are off by about {:.2g} of the motion: rotations or stretches are too large "
      "for them. {}",
      error, kRemedy);
}

// What steps may have missed of loads and of the motion of supports.
void add_warnings(const Outcome& outcome, std::vector<std::string>& all) {
  if (outcome.stepped_over)
    all.push_back(
        fmt::format("the step after t = {:.4g} s is long against what a load or a support does in it, and fixed: much "
                    "of that is missed. Lower integrator.step, or leave it to error control (integrator.rtol)",
                    *outcome.stepped_over));
  if (outcome.unresolved)
    all.push_back(
        fmt::format("a formula of a load or a support jumps, or changes within less than a {}th of the run, at t = "
                    "{:.4g} s: steps may miss it. Name the times of jumps by `kinks`, or set integrator.h_max",
                    StepLimits::kMostParts, *outcome.unresolved));
}

void add_few_states(const std::vector<RecordedExtreme>& extremes, std::vector<std::string>& all) {
  constexpr long kFewStates = 50;
  const auto few = std::find_if(extremes.begin(), extremes.end(),
                                [](const RecordedExtreme& extreme) { return extreme.states < kFewStates; });
  if (few != extremes.end())
    all.push_back(
        fmt::format("extremes are those of {}: peaks between them are missed; output.history: {{steps: "
                    "true}} looks at every step",
                    counted(few->states, "state")));
}

void add_warnings(const EquilibriumResult& equilibrium, std::vector<std::string>& all) {
  if (!(equilibrium.det_f.value > 0))
    all.push_back(fmt::format("element {} is inverted (det F = {:.3g}): this equilibrium has no meaning",
                              equilibrium.det_f.element, equilibrium.det_f.value));
  if (equilibrium.residual_above_tolerance && !(equilibrium.residual <= kLargeResidual * equilibrium.largest_load))
    all.push_back(
        fmt::format("the residual, {:.2g} of the largest load, is above statics.solver.rtol, though Newton's next "
                    "correction is below it: most often by the round-off of large internal forces. Raise "
                    "statics.solver.rtol",
                    equilibrium.residual / equilibrium.largest_load));
}

}  // namespace

std::vector<std::string> result_warnings(const RunResult& result) {
  std::vector<std::string> all;
  if (result.buckling && result.buckling->unsymmetric) all.push_back(kUnsymmetricLoads);
  add_warnings(result.outcome, all);
  if (result.equilibrium) add_warnings(*result.equilibrium, all);
  if (const auto& strain = result.passed_strain)
    all.push_back(fmt::format("{} (the most at {} {:.4g}{})", strain->sentence,
                              result.equilibrium ? "load factor" : "t =", strain->time,
                              result.equilibrium ? "" : " s"));
  for (auto& sentence : exceeded_strengths(result.extremes, !result.motion)) all.push_back(std::move(sentence));
  if (result.motion) add_few_states(result.extremes, all);
  const auto& mesh = result.motion        ? result.motion->mesh_error
                     : result.equilibrium ? result.equilibrium->mesh_error
                                          : std::nullopt;
  if (mesh && mesh->relative > kCoarseMesh) all.push_back(mesh_sentence(result.model, mesh->relative));
  if (mesh)
    if (auto sentence = stress_warning(*mesh, result.model.order); !sentence.empty())
      all.push_back(std::move(sentence));
  if (mesh && !mesh->blind.empty()) all.push_back(blindness_warning(mesh->blind));
  if (const auto& error = result.model.linear_error; error && *error > kMuchError)
    all.push_back(result.model.buckles ? kBuckles : linearity_sentence(*error));
  if (const auto& motion = result.motion) {
    if (!(motion->det_f.value > 0))
      all.push_back(fmt::format("element {} was inverted at t = {:.4g} s (det F = {:.3g})", motion->det_f.element,
                                motion->det_f.time, motion->det_f.value));
    all.insert(all.end(), motion->doubts.begin(), motion->doubts.end());
    if (motion->energy && !(motion->energy->relative_drift <= kMuchDrift))
      all.push_back(drift_sentence(*motion->energy));
    if (motion->accumulated && !(motion->accumulated->error <= kMuchError))
      all.push_back(accumulation_sentence(*motion));
  }
  return all;
}

}  // namespace orthodyn
