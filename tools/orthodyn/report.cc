#include "tools/orthodyn/report.h"

#include <fmt/format.h>

#include <cmath>

#include "lib/simulation/machine.h"

namespace orthodyn {

namespace {

// An error of a tenth of the motion: curves no longer lie over each other.
constexpr double kUnresolved = 0.1;

// Where a run came to its end: the places that are likely to be at fault.
Json whereabouts(const RunReport& report) {
  const auto& last = report.outcome.last;
  const auto speed = report.setup.built.model->evaluate("speed.largest", last);
  const auto det_f = report.setup.built.model->evaluate("det_f.smallest", last);
  return {{"time", last.t},
          {"element_with_smallest_det_f", static_cast<long>(det_f[1])},
          {"smallest_det_f", det_f[0]},
          {"fastest_node", static_cast<long>(speed[1])},
          {"largest_speed", speed[0]}};
}

Json energies(const EnergyWriter& energy) {
  const auto& e = energy.last();
  return {{"kinetic", e.kinetic},         {"elastic", e.elastic},
          {"gravitational", e.gravitational}, {"dissipated", e.dissipated},
          {"loads", e.loads},             {"balance_drift", energy.drift()},
          {"scale", energy.scale()}};
}

}  // namespace

Json terms_json(const FemModel& model) {
  Json out = Json::array();
  for (const auto& term : model.parts().elastic) out.push_back(term->description());
  for (const auto& term : model.parts().loads) out.push_back(term->description());
  return out;
}

int exit_code(Outcome::Status status) {
  return status == Outcome::Status::completed ? 0 : status == Outcome::Status::interrupted ? 130 : 3;
}

namespace {

Json decisions(const Integrator& integrator) {
  Json out;
  for (const auto& [key, value] : integrator.decisions()) out[key] = value;
  return out;
}

Json to_json(const ErrorNorms& e) { return {{"final", e.final}, {"rms", e.l2}, {"largest", e.max}}; }

Json to_json(const ErrorEstimate& e) {
  Json out{{"against", e.against}, {"wall_seconds", e.wall_seconds}};
  if (!e.completed) {
    out["trouble"] = e.trouble;
    return out;
  }
  out["samples"] = e.samples;
  out["displacement"] = to_json(e.displacement);
  out["velocity"] = to_json(e.velocity);
  return out;
}

}  // namespace

std::string run_json(const RunArguments& arguments, const std::vector<Restart>& restarts, const RunReport* report) {
  Json out{{"status", report ? status_word(report->outcome.status) : "running"},
                   {"scene", arguments.scene},
                   {"set", arguments.set},
                   {"versions", versions_json()},
                   {"machine", machine_json()}};
  for (const auto& r : restarts)
    out["restarts"].push_back({{"time", r.time}, {"at", r.at}, {"after", r.after}, {"changed", r.changed}});
  if (!report) return out.dump(2) + "\n";
  const auto& model = *report->setup.built.model;
  out["model"] = {{"nodes", model.parts().mesh.nodes.size()},
                  {"elements", model.parts().mesh.tets.size()},
                  {"unknowns", model.num_dofs()},
                  {"terms", terms_json(model)}};
  out["integrator"] = decisions(*report->setup.integrator);
  out["time_reached"] = report->outcome.last.t;
  out["wall_seconds"] = report->effort.wall_seconds;
  out["cpu_seconds"] = report->effort.cpu_seconds;
  out["statistics"] = to_json(report->effort.statistics);
  out["factor_bytes"] = report->setup.integrator->factor_bytes();
  out["smallest_det_f"] = {{"value", report->inversion.smallest()},
                           {"element", report->inversion.element()},
                           {"time", report->inversion.time()}};
  if (report->energy) out["energy"] = energies(*report->energy);
  if (report->momentum)
    out["momentum"] = {{"angular_drift", report->momentum->angular_drift()},
                       {"angular_scale", report->momentum->angular_scale()}};
  if (report->error) out["estimated_error"] = to_json(*report->error);
  if (!report->outcome.remark.empty()) out["remark"] = report->outcome.remark;
  if (report->outcome.status == Outcome::Status::failed)
    out["failure"] = {{"reason", reason_name(report->outcome.reason)},
                      {"message", report->outcome.message},
                      {"where", whereabouts(*report)}};
  return out.dump(2) + "\n";
}

void print_summary(const RunReport& report, const std::filesystem::path& folder) {
  const auto& s = report.effort.statistics;
  const auto& outcome = report.outcome;
  const auto type = report.setup.config.at("integrator").at("type").text();
  fmt::print("{} with {}: {} unknowns, {} at t = {:.6g} s after {:.2f} s ({:.2f} s CPU)\n", report.arguments.scene,
             type, report.setup.built.model->num_dofs(), status_word(outcome.status), outcome.last.t,
             report.effort.wall_seconds, report.effort.cpu_seconds);
  if (!outcome.remark.empty()) fmt::print("  {}\n", outcome.remark);
  const auto& elastic = *report.setup.built.model->parts().elastic.front();
  fmt::print("  {:<15} {}\n", "elasticity", elastic.law());
  for (const auto& [key, value] : report.setup.integrator->decisions()) fmt::print("  {:<15} {}\n", key, value);
  fmt::print("  {:<15} {} ({} rejected), {} Newton iterations", "steps", s.steps, s.rejected_steps, s.newton_iterations);
  if (s.gauss_newton_fallbacks > 0) fmt::print(", {} indefinite tangents replaced", s.gauss_newton_fallbacks);
  fmt::print("\n");
  const auto line = [](const char* name, const Cost& c) {
    fmt::print("  {:<15} {:6} x {:9.3f} ms = {:8.3f} s\n", name, c.count,
               c.count ? 1e3 * c.seconds / static_cast<double>(c.count) : 0, c.seconds);
  };
  line("force", s.force);
  line("tangent", s.tangent);
  line("factorisation", s.factorization);
  line("solve", s.solve);
  if (report.energy) {
    const auto& e = report.energy->last();
    fmt::print("  {:<15} kinetic {:.4g} J, elastic {:.4g} J, gravitational {:.4g} J, dissipated {:.4g} J, loads {:.4g} J\n",
               "energy", e.kinetic, e.elastic, e.gravitational, e.dissipated, e.loads);
    fmt::print("  {:<15} {:.3g} of the largest energy\n", "balance drift", report.energy->relative_drift());
  }
  if (report.momentum && report.momentum->angular_scale() > 0)
    fmt::print("  {:<15} {:.3g} of the initial angular momentum\n", "momentum drift",
               report.momentum->angular_drift() / report.momentum->angular_scale());
  fmt::print("  {:<15} {:.4g} in element {} at t = {:.4g} s{}\n", "smallest det F", report.inversion.smallest(),
             report.inversion.element(), report.inversion.time(),
             report.inversion.smallest() <= 0 ? ": INVERTED" : "");
  fmt::print("  {:<15} {}\n", "results", folder.string());
}

void print_error(const ErrorEstimate& error) {
  if (!error.completed) {
    fmt::print(stderr, "warning: no estimate of the error: the run with {} did not complete: {}\n", error.against,
               error.trouble);
    return;
  }
  fmt::print("  {:<15} against {} ({:.2f} s), mass norm relative to the largest value:\n", "estimated error",
             error.against, error.wall_seconds);
  fmt::print("  {:<15} {:>10} {:>10} {:>10}\n", "", "at the end", "rms", "largest");
  for (const auto& [name, e] : {std::pair{"displacement", error.displacement}, {"velocity", error.velocity}})
    fmt::print("    {:<13} {:>10.2g} {:>10.2g} {:>10.2g}\n", name, e.final, e.l2, e.max);
  const auto& u = error.displacement;
  if (std::isnan(u.max)) fmt::print("  nothing moves: there is nothing to compare with\n");
  else
    fmt::print("  the integration puts displacements off by about {:.2g} % of the largest, {:.2g} % at worst; velocities "
               "by {:.2g} %, {:.2g} % at worst; the mesh's error comes on top{}\n",
               100 * u.l2, 100 * u.max, 100 * error.velocity.l2, 100 * error.velocity.max,
               u.max > kUnresolved ? ". The motion is NOT resolved: lower integrator.rtol or step" : "");
}

}  // namespace orthodyn
