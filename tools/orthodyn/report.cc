#include "tools/orthodyn/report.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "lib/core/versions.h"
#include "lib/linear/blas.h"

namespace orthodyn {

namespace {

using nlohmann::ordered_json;

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

const char* status_word(Outcome::Status status) {
  switch (status) {
    case Outcome::Status::completed: return "completed";
    case Outcome::Status::interrupted: return "interrupted";
    case Outcome::Status::failed: return "failed";
  }
  return "";
}

ordered_json versions() {
  ordered_json out{{"orthodyn", orthodyn_version()}};
  for (const auto& [library, version] : library_versions()) out[library] = version;
  out["BLAS"] = blas_name();
  return out;
}

ordered_json cost(const Cost& c) { return {{"count", c.count}, {"seconds", c.seconds}}; }

ordered_json statistics(const Statistics& s) {
  return {{"steps", s.steps},
          {"rejected_steps", s.rejected_steps},
          {"error_test_failures", s.error_test_failures},
          {"convergence_failures", s.convergence_failures},
          {"newton_iterations", s.newton_iterations},
          {"gauss_newton_fallbacks", s.gauss_newton_fallbacks},
          {"force", cost(s.force)},
          {"tangent", cost(s.tangent)},
          {"factorization", cost(s.factorization)},
          {"solve", cost(s.solve)}};
}

// Where a run came to its end: the places that are likely to be at fault.
ordered_json whereabouts(const RunReport& report) {
  const auto& last = report.outcome.last;
  const auto speed = report.setup.built.model->evaluate("speed.largest", last);
  const auto det_f = report.setup.built.model->evaluate("det_f.smallest", last);
  return {{"time", last.t},
          {"element_with_smallest_det_f", static_cast<long>(det_f[1])},
          {"smallest_det_f", det_f[0]},
          {"fastest_node", static_cast<long>(speed[1])},
          {"largest_speed", speed[0]}};
}

ordered_json energies(const EnergyWriter& energy) {
  const auto& e = energy.last();
  return {{"kinetic", e.kinetic},         {"elastic", e.elastic},
          {"gravitational", e.gravitational}, {"dissipated", e.dissipated},
          {"loads", e.loads},             {"balance_drift", energy.drift()},
          {"scale", energy.scale()}};
}

ordered_json terms(const FemModel& model) {
  ordered_json out = ordered_json::array();
  for (const auto& term : model.parts().elastic) out.push_back(term->description());
  for (const auto& term : model.parts().loads) out.push_back(term->description());
  return out;
}

ordered_json decisions(const Integrator& integrator) {
  ordered_json out;
  for (const auto& [key, value] : integrator.decisions()) out[key] = value;
  return out;
}

}  // namespace

void InversionWatch::look(const State& state) {
  const auto now = model_.evaluate("det_f.smallest", state);
  if (element_ >= 0 && now[0] >= smallest_) return;
  smallest_ = now[0];
  element_ = static_cast<int>(now[1]);
  time_ = state.t;
}

std::string run_json(const RunArguments& arguments, const RunReport* report) {
  ordered_json out{{"status", report ? status_word(report->outcome.status) : "running"},
                   {"scene", arguments.scene},
                   {"set", arguments.set},
                   {"versions", versions()},
                   {"machine", {{"processor", processor()}, {"cores", std::thread::hardware_concurrency()}}}};
  if (!report) return out.dump(2) + "\n";
  const auto& model = *report->setup.built.model;
  out["model"] = {{"nodes", model.parts().mesh.nodes.size()},
                  {"elements", model.parts().mesh.tets.size()},
                  {"unknowns", model.num_dofs()},
                  {"terms", terms(model)}};
  out["integrator"] = decisions(*report->setup.integrator);
  out["time_reached"] = report->outcome.last.t;
  out["wall_seconds"] = report->outcome.wall_seconds;
  out["cpu_seconds"] = report->outcome.cpu_seconds;
  out["statistics"] = statistics(report->setup.integrator->statistics());
  out["factor_bytes"] = report->setup.integrator->factor_bytes();
  out["smallest_det_f"] = {{"value", report->inversion.smallest()},
                           {"element", report->inversion.element()},
                           {"time", report->inversion.time()}};
  if (report->energy) out["energy"] = energies(*report->energy);
  if (report->momentum)
    out["momentum"] = {{"angular_drift", report->momentum->angular_drift()},
                       {"angular_scale", report->momentum->angular_scale()}};
  if (report->outcome.status == Outcome::Status::failed)
    out["failure"] = {{"reason", reason_name(report->outcome.reason)},
                      {"message", report->outcome.message},
                      {"where", whereabouts(*report)}};
  return out.dump(2) + "\n";
}

void print_summary(const RunReport& report, const std::filesystem::path& folder) {
  const auto& s = report.setup.integrator->statistics();
  const auto& outcome = report.outcome;
  const auto type = report.setup.config.at("integrator").at("type").text();
  fmt::print("{} with {}: {} unknowns, {} at t = {:.6g} s after {:.2f} s ({:.2f} s CPU)\n", report.arguments.scene,
             type, report.setup.built.model->num_dofs(), status_word(outcome.status), outcome.last.t,
             outcome.wall_seconds, outcome.cpu_seconds);
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
    fmt::print("  {:<15} {:.3g} of the largest energy\n", "balance drift",
               report.energy->scale() > 0 ? report.energy->drift() / report.energy->scale() : 0);
  }
  if (report.momentum && report.momentum->angular_scale() > 0)
    fmt::print("  {:<15} {:.3g} of the initial angular momentum\n", "momentum drift",
               report.momentum->angular_drift() / report.momentum->angular_scale());
  fmt::print("  {:<15} {:.4g} in element {} at t = {:.4g} s{}\n", "smallest det F", report.inversion.smallest(),
             report.inversion.element(), report.inversion.time(),
             report.inversion.smallest() <= 0 ? ": INVERTED" : "");
  fmt::print("  {:<15} {}\n", "results", folder.string());
}

}  // namespace orthodyn
