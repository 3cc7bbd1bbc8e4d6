#include "tools/orthodyn/run_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "lib/core/number_format.h"
#include "lib/core/parse_number.h"
#include "lib/core/spelling.h"
#include "lib/simulation/error_estimate/error_balance.h"
#include "lib/simulation/run/result_warnings.h"

namespace orthodyn {

namespace {

constexpr double kUnresolved = 0.1;  // error relative to the largest motion: curves differ visibly

void print_cost(const char* name, const Cost& c, const char* unit = "") {
  fmt::print("  {:<15} {:6}{} x {:9.3f} ms = {:8.3f} s\n", name, c.count, unit,
             c.count ? 1e3 * c.seconds / static_cast<double>(c.count) : 0, c.seconds);
}

// Prints the cost of outputs and events: per observed state if there are more states than steps, else per step.
void print_observation(const RunResult& result, Cost cost) {
  long states = 0;
  if (const auto& energy = result.motion->energy) states = static_cast<long>(energy->states);
  for (const auto& extreme : result.extremes) states = std::max(states, extreme.states);
  const bool are_more = states > cost.count;
  if (are_more) cost.count = states;
  print_cost("outputs, events", cost, are_more ? " states" : " steps");
}

void print_costs(const RunResult& result) {
  const Statistics& s = result.motion->cost.statistics;
  fmt::print("  {:<15} {} ({} rejected), {}", "steps", s.steps, s.rejected_steps,
             counted(s.newton_iterations, "Newton iteration"));
  if (s.gauss_newton_fallbacks > 0)
    fmt::print(", {} replaced", counted(s.gauss_newton_fallbacks, "indefinite tangent"));
  fmt::print("\n");
  print_cost("force", s.force);
  print_cost("tangent", s.tangent);
  print_cost("factorisation", s.factorization);
  print_cost("solve", s.solve);
  if (s.sensitivity.count > 0) print_cost("sensitivities", s.sensitivity);
  if (s.modes.count > 0) print_cost("modes", s.modes);
  if (s.observation.count > 0) print_observation(result, s.observation);
}

void print_energy(const EnergySummary& energy) {
  const auto& e = energy.last;
  fmt::print(
      "  {:<15} kinetic {:.4g} J, elastic {:.4g} J, gravitational {:.4g} J, dissipated {:.4g} J, loads {:.4g} J\n",
      "energy", e.kinetic, e.elastic, e.gravitational, e.dissipated, e.loads);
  fmt::print("  {:<15} {:.3g} of the largest energy, {}\n", "balance drift", energy.relative_drift,
             energy.times == EnergyTimes::steps ? "over all steps" : "at the outputs");
}

// `width`: width of the first column.
void print_errors(const RunResult& result, int width) {
  const auto errors = error_balance(result);
  if (!errors) return;
  fmt::print("  {:<{}} mesh {:.1e} of the elastic energy (by {}){}{}{}\n", "errors, about", width, errors->mesh,
             errors->mesh_by,
             errors->time    ? fmt::format(", time {:.1e} of the motion", *errors->time)
             : result.motion ? ", time not estimated (--estimate-error)"
                             : "",
             errors->advice.empty() ? "" : ": ", errors->advice);
  if (errors->probed_unknown)
    fmt::print("  {:<{}} of stresses and strains at probes unknown: only an estimate by finer elements gives them\n",
               "", width);
  for (const ProbedError& e : errors->probed)
    fmt::print("  {:<{}} {} of {} {:.1e}{} ({:.2g} % of its size), due to the mesh\n", "", width, e.field, e.probe,
               e.error, e.unit == "1" ? "" : " " + e.unit, 100 * e.share());
}

// Names the folder, and the table of derivatives if there is one. `width`: width of the first column.
void print_folder(const RunResult& result, int width) {
  fmt::print("  {:<{}} {}\n", "results", width, result.folder.string());
  const auto table = result.folder / "sensitivities.csv";
  if (std::error_code error; std::filesystem::exists(table, error))
    fmt::print("  {:<{}} {}\n", "derivatives", width, table.string());
}

std::string three(const Vec3& v, const char* format) {
  const auto number = [&](double x) { return fmt::format(fmt::runtime(format), x); };
  return fmt::format("({}, {}, {})", number(v[0]), number(v[1]), number(v[2]));
}

// Three numbers, each with the digits that its error justifies.
std::string three_known(const Vec3& v, const Vec3& error) {
  const auto number = [&](int i) { return known_digits(v[i], v[i] == 0 ? 0 : error[i] / v[i]); };
  return fmt::format("({}, {}, {})", number(0), number(1), number(2));
}

void print_extremes(const RunResult& result, bool is_static) {
  for (const auto& e : result.extremes) {
    if (e.node < 0) fmt::print("  {}: no node has a value\n", e.quantity);
    else
      fmt::print("  {}: {:.4g}{} {}at {} m, {} {:.4g}{}, of {}\n", e.quantity, e.value,
                 e.unit.empty() ? "" : " " + e.unit, in_region(e), three(e.place, "{:.4g}"),
                 is_static ? "at load factor" : "at t =", e.time, is_static ? "" : " s", counted(e.states, "state"));
  }
}

void print_motion(const RunResult& result, const MotionResult& motion) {
  const auto& outcome = result.outcome;
  fmt::print("{} with {}: {} unknowns, {} at t = {:.6g} s after {:.2f} s ({:.2f} s CPU)\n", result.scene,
             motion.integrator, result.model.unknowns, status_word(outcome.status), outcome.last.t,
             motion.cost.wall_seconds, motion.cost.cpu_seconds);
  if (!outcome.remark.empty()) fmt::print("  {}\n", outcome.remark);
  fmt::print("  {:<15} {}\n", "elasticity", result.model.elasticity);
  if (!result.model.kinematics.empty()) fmt::print("  {:<15} {}\n", "kinematics", result.model.kinematics);
  for (const auto& [key, value] : motion.decisions) fmt::print("  {:<15} {}\n", key, rounded_number(value));
  print_costs(result);
  if (motion.energy) print_energy(*motion.energy);
  if (motion.momentum && motion.momentum->angular_scale > 0)
    fmt::print("  {:<15} {:.3g} of the initial angular momentum\n", "momentum drift",
               motion.momentum->angular_drift / motion.momentum->angular_scale);
  if (const auto& j = motion.joints)
    fmt::print("  {:<15} at most {:.2g} m apart, at a rate of at most {:.2g} m/s\n", "joints", j->gap, j->rate);
  if (const auto& c = motion.contacts; c && !c->untouched.empty() && c->untouched.size() < c->count)
    fmt::print("  {:<15} never touched: {}\n", "contact", join(c->untouched));
  if (const auto& e = motion.segment_error)
    fmt::print(
        "  {:<15} about {:.2g} of the largest motion since t = {:.4g} s, by {} segment{} of {} steps against {} "
        "({:.2f} s)\n",
        "error", e->error, e->since, e->segments, e->segments == 1 ? "" : "s", e->steps, e->against, e->wall_seconds);
  print_errors(result, 15);
  print_extremes(result, false);
  if (!motion.events_not_found.empty())
    fmt::print("  {:<15} never happened: {}\n", "events", join(motion.events_not_found));
  if (motion.det_f.element >= 0)
    fmt::print("  {:<15} {:.4g} in element {} at t = {:.4g} s{}\n", "smallest det F", motion.det_f.value,
               motion.det_f.element, motion.det_f.time, motion.det_f.value <= 0 ? ": INVERTED" : "");
  print_folder(result, 15);
}

std::string turning_point_text(const CriticalPoint& turn) {
  return fmt::format(
      ": the body buckles or loses a support; the equilibria {} followed beyond it (statics.at_limit acts at limit "
      "points and bifurcations only)",
      turn.unstable ? "stay stable and were" : "were");
}

void print_equilibrium(const RunResult& result, const EquilibriumResult& equilibrium) {
  const auto& outcome = result.outcome;
  fmt::print("{}, static: {} unknowns, {} at load factor {:.6g} after {:.2f} s\n", result.scene, result.model.unknowns,
             status_word(outcome.status), outcome.last.t, outcome.wall_seconds);
  fmt::print("  {:<20} {} ({} cut back), {}\n", "load steps", equilibrium.load_steps, equilibrium.rejected_load_steps,
             counted(equilibrium.statistics.newton_iterations, "Newton iteration"));
  for (const CriticalPoint& point : equilibrium.critical_points)
    fmt::print("  {:<20} at load factor {:.6g} +- {:.1g}{}\n", words_of(point.kind), point.load_factor,
               point.uncertainty, point.kind == CriticalPoint::Kind::turn ? turning_point_text(point) : "");
  if (equilibrium.jumps > 0)
    fmt::print("  {:<20} {}, to a stable equilibrium of lower energy on another path\n", "jumps", equilibrium.jumps);
  if (equilibrium.unstable.value_or(0) > 0)
    fmt::print("  {:<20} the last equilibrium is unstable in {}\n", "stability",
               equilibrium.unsymmetric ? "an odd number of directions" : counted(*equilibrium.unstable, "direction"));
  else if (equilibrium.unsymmetric)
    fmt::print(
        "  {:<20} judged by the sign of the determinant, since the stiffness is unsymmetric; growing vibrations "
        "(flutter) are not detected\n",
        "stability");
  fmt::print("  {:<20} {}\n", "solver", equilibrium.solver);
  if (!result.model.kinematics.empty()) fmt::print("  {:<20} {}\n", "kinematics", result.model.kinematics);
  fmt::print("  {:<20} {:.6g} m\n", "largest displacement", equilibrium.largest_displacement);
  fmt::print("  {:<20} {:.2g} N, {:.2g} of the largest load component\n", "residual", equilibrium.residual,
             equilibrium.residual / std::max(equilibrium.largest_load, 1e-300));
  print_errors(result, 20);
  print_extremes(result, true);
  for (const auto& [probe, value, error] : equilibrium.probes)
    fmt::print("  {:<20} displacement {} m{}\n", probe, three_known(value, error),
               error.allFinite() ? fmt::format(", mesh error about {} m", three(error, "{:.1e}")) : "");
  print_folder(result, 20);
}

void print_buckling(const RunResult& result, const BucklingResult& buckling) {
  fmt::print("{}, buckling: {} unknowns, {} after {:.2f} s\n", result.scene, result.model.unknowns,
             status_word(result.outcome.status), result.outcome.wall_seconds);
  if (!buckling.modes.empty()) fmt::print("  mode  load factor   mesh error    residual\n");
  for (std::size_t k = 0; k < buckling.modes.size(); ++k) {
    const auto& mode = buckling.modes[k];
    fmt::print("  {:4}  {:>11}  {:>12}   {:8.1e}\n", k + 1, known_digits(mode.load_factor, mode.mesh_error),
               fmt::format("{:+.2g} %", 100 * mode.mesh_error), mode.residual);
  }
  if (std::ssize(buckling.modes) < buckling.wanted && !buckling.modes.empty())
    fmt::print(
        "  {} of the {} requested modes lie below load factor {:.4g}, where linear statics reach a strain of 10 %; "
        "higher ones are no buckling loads\n",
        buckling.modes.size(), buckling.wanted, buckling.limit);
  print_folder(result, 20);
}

void print_harmonic(const RunResult& result, const HarmonicResult& harmonic) {
  fmt::print("{}, harmonic: {} unknowns, {} after {:.2f} s\n", result.scene, result.model.unknowns,
             status_word(result.outcome.status), result.outcome.wall_seconds);
  if (result.outcome.status != Outcome::Status::completed) return;
  fmt::print("  {:<20} {}\n", "vibration about", harmonic.is_loaded ? "the equilibrium under steady loads" : "rest");
  fmt::print("  {:<20} {} from {:.6g} to {:.6g} Hz\n", "frequencies", harmonic.frequencies, harmonic.lowest,
             harmonic.highest);
  fmt::print("  {:<20} about {:.1e} for this mesh, from {} vectors (harmonic.rtol {:.1e})\n", "amplitude error",
             harmonic.error, harmonic.basis, harmonic.rtol);
  if (!harmonic.modes.empty()) fmt::print("  mode  frequency [Hz]   damping ratio   mesh error\n");
  for (std::size_t k = 0; k < harmonic.modes.size(); ++k) {
    const auto& [frequency, damping_ratio, mesh_error] = harmonic.modes[k];
    fmt::print("  {:4}  {:>14}  {:>14.4g}  {:>11}\n", k + 1, known_digits(frequency, mesh_error), damping_ratio,
               mesh_error == 0 ? "" : fmt::format("{:+.2g} %", 100 * mesh_error));
  }
  fmt::print("  largest amplitudes\n");
  for (const auto& [quantity, unit, frequency, amplitude] : harmonic.peaks)
    fmt::print("    {:<34} {:>10.4g} {:<6} at {:.6g} Hz\n", quantity, amplitude, unit, frequency);
  print_folder(result, 20);
}

void print_how_to_continue(const RunResult& result) {
  if (result.outcome.status == Outcome::Status::interrupted)
    fmt::print(stderr, "interrupted at t = {:.6g} s; the results so far are in {}\n", result.outcome.last.t,
               result.folder.string());
  if (result.outcome.status != Outcome::Status::completed && result.resumable)
    fmt::print(stderr, "to continue: orthodyn run {} --resume{}\n", result.folder.string(),
               result.ranks > 1 ? fmt::format(" --ranks {}", result.ranks) : "");
}

}  // namespace

std::string rounded_number(const std::string& text) {
  double value = 0;
  return parse_number(std::string_view(text), value) ? fmt::format("{:.4g}", value) : text;
}

void print_result(const RunResult& result, bool quiet) {
  if (result.outcome.status == Outcome::Status::failed) fmt::print(stderr, "error: {}\n", result.outcome.message);
  if (result.equilibrium && !quiet) print_equilibrium(result, *result.equilibrium);
  if (result.buckling && !quiet) print_buckling(result, *result.buckling);
  if (result.harmonic && !quiet) print_harmonic(result, *result.harmonic);
  if (result.motion && !quiet) print_motion(result, *result.motion);
  for (const auto& warning : result_warnings(result)) fmt::print(stderr, "warning: {}\n", warning);
  if (result.motion) print_how_to_continue(result);
}

void print_estimate(const RunResult& result) {
  const ErrorEstimate& error = *result.motion->error;
  if (!error.completed) {
    fmt::print(stderr, "warning: no error estimate: the run with {} did not complete: {}\n", error.against,
               error.failure_reason);
    return;
  }
  fmt::print("  {:<15} against {} ({:.2f} s), mass norm relative to the largest value:\n", "estimated error",
             error.against, error.wall_seconds);
  fmt::print("  {:<15} {:>10} {:>10} {:>10}\n", "", "at the end", "rms", "largest");
  for (const auto& [name, e] : {std::pair{"displacement", error.displacement}, {"velocity", error.velocity}})
    fmt::print("    {:<13} {:>10.2g} {:>10.2g} {:>10.2g}\n", name, e.final, e.l2, e.max);
  const auto& u = error.displacement;
  if (std::isnan(u.max)) fmt::print("  nothing moves: there is no scale for the error\n");
  else
    fmt::print(
        "  integration error of displacements: about {:.2g} % of the largest, {:.2g} % at worst; of velocities {:.2g} "
        "%, {:.2g} % at worst{}\n",
        100 * u.l2, 100 * u.max, 100 * error.velocity.l2, 100 * error.velocity.max,
        u.max > kUnresolved ? ". The motion is NOT resolved: reduce integrator.rtol or the step" : "");
  print_errors(result, 15);
}

}  // namespace orthodyn
