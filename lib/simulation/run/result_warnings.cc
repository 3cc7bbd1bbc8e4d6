#include "lib/simulation/run/result_warnings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/core/spelling.h"
#include "lib/simulation/error_estimate/estimated_error.h"

namespace orthodyn {

namespace {

constexpr double kLargeDrift = 0.01;  // of the largest energy
constexpr double kLargeError = 0.05;  // of the largest displacement
constexpr double kLargeGap = 10;      // of joints, in rtol times the extent of the mesh
// Relative to the largest load. Smaller residuals are round-off of the internal forces of slender bodies, whose
// displacements are accurate.
constexpr double kLargeResidual = 1e-6;

template <class... Arguments>
void add_warning(std::vector<std::string>& all, fmt::format_string<Arguments...> message, Arguments&&... arguments) {
  all.push_back(fmt::format(message, std::forward<Arguments>(arguments)...));
}

// With few states, the true largest energy may be larger than the one observed.
std::string drift_sentence(const EnergySummary& energy, bool is_by_barrier) {
  constexpr const char* kGeneral =
      "the integration creates or loses energy, or does not resolve the dissipation of fast vibrations. Estimate the "
      "error of the motion with --estimate-error, or use a smaller integrator.rtol or integrator.step";
  constexpr const char* kBarrier =
      "positions are not accurate to a small part of the gap of a barrier contact, or vibrations are not resolved. "
      "Use a smaller integrator.rtol (of a fixed step, integrator.step), or a larger gap with a smaller stiffness";
  return fmt::format(
      "the energy balance drifts by {:.2g} of the largest energy{}: {}", energy.relative_drift,
      energy.states > 2 ? ""
                        : ", evaluated at the start and the end only (output.energy_times: steps evaluates it at every "
                          "step, and may find a larger energy)",
      is_by_barrier ? kBarrier : kGeneral);
}

// Type of the integrator, or the method that `auto` has chosen.
std::string method_of(const MotionResult& motion) {
  for (const auto& [key, value] : motion.decisions)
    if (key == "method") return value;
  return motion.integrator;
}

std::string accumulation_sentence(const MotionResult& motion) {
  return fmt::format(
      "the errors of {} steps, each within its tolerance, may have accumulated to {:.2g} of the largest motion, most "
      "often as a phase error. Take smaller steps (integrator.rtol, integrator.step), use {}, or estimate the error "
      "with --estimate-error",
      motion.cost.statistics.steps, motion.segment_error->error,
      method_of(motion) == "arkode_dirk" ? "a smaller integrator.h_max" : "integrator.type: arkode_dirk");
}

std::string mesh_sentence(const ModelSummary& model, double error) {
  return fmt::format(
      "the mesh is coarse for this motion: its error is about {:.2g} of the elastic energy. Deflections are mostly "
      "too small and frequencies too high. {}, and compare (the frame field mesh_error shows where)",
      error, finer_mesh(model.order));
}

constexpr const char* kBuckles =
    "the body buckles below these loads, which linear kinematics do not show. Use elasticity.kinematics: auto or "
    "corotational; analysis: buckling computes the load factors";

constexpr const char* kUnsymmetricLoads =
    "the stiffness of a follower pressure on a surface with a free edge is unsymmetric; buckling uses its symmetric "
    "part: load factors may be inaccurate, and flutter is not found. analysis: static follows the path with the full "
    "stiffness";

std::string linearity_sentence(double error) {
  constexpr const char* kRemedy = "Use elasticity.kinematics: auto or corotational";
  if (!std::isfinite(error))
    return fmt::format(
        "the error of linear kinematics could not be estimated: rotations or stretches are too large for them. {}",
        kRemedy);
  return fmt::format(
      "linear kinematics are off by about {:.2g} of the motion: rotations or stretches are too large for them. {}",
      error, kRemedy);
}

// Features of loads and support motions that steps may have missed.
void add_warnings(const Outcome& outcome, std::vector<std::string>& all) {
  if (outcome.stepped_over)
    add_warning(all,
                "the fixed step after t = {:.4g} s is longer than a load or a support motion allows, and misses part "
                "of it. Lower integrator.step, or use error control (integrator.rtol)",
                *outcome.stepped_over);
  if (outcome.may_pass_through)
    add_warning(all,
                "the fixed step after t = {:.4g} s is so long that bodies may have passed through each other. Lower "
                "integrator.step, or use error control (integrator.rtol)",
                *outcome.may_pass_through);
  if (outcome.unresolved_change)
    add_warning(all,
                "the formula of a load or a support jumps, or changes within less than 1/{} of the run, at t = {:.4g} "
                "s: steps may miss it. List the times of jumps in `kinks`, or set integrator.h_max",
                StepLimits::kMostParts, *outcome.unresolved_change);
}

void add_few_states(const std::vector<RecordedExtreme>& extremes, std::vector<std::string>& all) {
  constexpr long kFewStates = 50;
  const auto few = std::find_if(extremes.begin(), extremes.end(), [](const RecordedExtreme& extreme) {
    return !extreme.between_rows && extreme.states < kFewStates;
  });
  if (few != extremes.end())
    add_warning(
        all,
        "extremes are those of {} only: peaks between these states are missed. Use output.history: {{steps: true}} to "
        "evaluate every step",
        counted(few->states, "state"));
}

void add_warnings(const EquilibriumResult& equilibrium, std::vector<std::string>& all) {
  if (!(equilibrium.det_f.value > 0))
    add_warning(all, "element {} is inverted (det F = {:.3g}): this equilibrium is meaningless",
                equilibrium.det_f.element, equilibrium.det_f.value);
  if (equilibrium.residual_above_tolerance && !(equilibrium.residual <= kLargeResidual * equilibrium.largest_load))
    add_warning(all,
                "the residual, {:.2g} of the largest load, is above statics.solver.rtol, though Newton's next "
                "correction is below it: most often round-off of large internal forces. Raise statics.solver.rtol",
                equilibrium.residual / equilibrium.largest_load);
}

void add_warnings(const HarmonicResult& harmonic, std::vector<std::string>& all) {
  if (harmonic.error > harmonic.rtol)
    add_warning(all, "amplitudes have an estimated error of {:.1e}, more than harmonic.rtol, {:.1e}: {}",
                harmonic.error, harmonic.rtol,
                harmonic.stagnated
                    ? "round-off prevents a smaller one. If it is small enough, increase rtol"
                    : "strong damping couples many modes. Increase rtol if this is enough, or lower the highest "
                      "frequency");
  if (!harmonic.missed.empty())
    add_warning(all,
                "the frequencies miss {}: none is within half a bandwidth of the natural frequency of {} {}, so that "
                "response.csv does not show the peak. Give more frequencies there, or from and to",
                counted(static_cast<long>(harmonic.missed.size()), "resonance"),
                harmonic.missed.size() == 1 ? "mode" : "modes", fmt::join(harmonic.missed, ", "));
  all.insert(all.end(), harmonic.warnings.begin(), harmonic.warnings.end());
}

}  // namespace

std::vector<std::string> result_warnings(const RunResult& result) {
  std::vector<std::string> all;
  if (result.buckling && result.buckling->unsymmetric) all.push_back(kUnsymmetricLoads);
  if (result.harmonic) add_warnings(*result.harmonic, all);
  add_warnings(result.outcome, all);
  if (result.equilibrium) add_warnings(*result.equilibrium, all);
  if (const auto& strain = result.exceeded_strain)
    add_warning(all, "{} (largest at {} {:.4g}{})", strain->sentence,
                result.equilibrium ? "load factor" : "t =", strain->time, result.equilibrium ? "" : " s");
  for (auto& sentence : exceeded_strengths(result.extremes, !result.motion)) all.push_back(std::move(sentence));
  if (result.motion) add_few_states(result.extremes, all);
  for (const RecordedExtreme& extreme : result.extremes)
    if (!extreme.remark.empty()) all.push_back(extreme.quantity + ": " + extreme.remark);
  const auto& mesh = result.motion        ? result.motion->mesh_error
                     : result.equilibrium ? result.equilibrium->mesh_error
                                          : std::nullopt;
  if (mesh && mesh->relative > kCoarseMesh) all.push_back(mesh_sentence(result.model, mesh->relative));
  if (mesh)
    if (auto sentence = stress_warning(*mesh, result.model.order); !sentence.empty())
      all.push_back(std::move(sentence));
  if (mesh && !mesh->locking_risk.empty()) all.push_back(locking_warning(mesh->locking_risk));
  if (const auto& error = result.model.linear_error; error && *error > kLargeError)
    all.push_back(result.model.buckles ? kBuckles : linearity_sentence(*error));
  if (const auto& motion = result.motion) {
    if (!(motion->det_f.value > 0))
      add_warning(all, "element {} was inverted at t = {:.4g} s (det F = {:.3g})", motion->det_f.element,
                  motion->det_f.time, motion->det_f.value);
    all.insert(all.end(), motion->warnings.begin(), motion->warnings.end());
    if (motion->energy && !(motion->energy->relative_drift <= kLargeDrift))
      all.push_back(drift_sentence(*motion->energy, result.model.has_barrier));
    if (motion->joints && motion->rtol && !(motion->joints->gap <= kLargeGap * *motion->rtol * motion->joints_extent))
      add_warning(
          all,
          "joined points were up to {:.2g} m apart, more than {:.0f} times rtol of the size of the bodies. Use a "
          "smaller integrator.rtol",
          motion->joints->gap, kLargeGap);
    if (motion->joints && !motion->joints->wound.empty())
      add_warning(
          all,
          "{} turned by more than 180 degrees, where the force of a spring or stop jumps: both take angles from "
          "-180 to 180 degrees. Use a motor or a load for turns",
          join(motion->joints->wound));
    if (const auto& c = motion->contacts;
        c && c->untouched.size() == c->count && result.outcome.status == Outcome::Status::completed)
      add_warning(all,
                  "nothing touched: {} had no force. Does the run end too early, or do the surfaces face away "
                  "from each other?",
                  join(c->untouched));
    if (motion->segment_error && !(motion->segment_error->error <= kLargeError))
      all.push_back(accumulation_sentence(*motion));
  }
  return all;
}

}  // namespace orthodyn
