#include "tools/orthodyn/predicted_cost.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <string>
#include <vector>

#include "lib/core/memory.h"
#include "lib/simulation/preflight/faster_setup.h"
#include "lib/simulation/preflight/output_size.h"
#include "lib/simulation/preflight/run_cost.h"
#include "lib/simulation/preflight/scene_cost.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

constexpr double kMeasuringSeconds = 1;  // for all terms together

void print_term_costs(const Setup& setup, const std::vector<TermCost>& costs) {
  TermCost all;
  for (const TermCost& cost : costs) all = {"", all.force + cost.force, all.tangent + cost.tangent};
  fmt::print("cost of one evaluation, measured\n");
  for (const TermCost& cost : costs)
    fmt::print("  {:<32} force {:9.4g} ms ({:3.0f} %), tangent {:9.4g} ms ({:3.0f} %)\n", cost.name, 1e3 * cost.force,
               100 * cost.force / all.force, 1e3 * cost.tangent, 100 * cost.tangent / all.tangent);
  const auto sentences = possible_savings(setup, costs);
  fmt::print("could be left out at an accuracy of {:.0e}\n", requested_accuracy(setup.scene));
  if (sentences.empty()) fmt::print("  nothing, judging by the linear response\n");
  for (const auto& sentence : sentences) fmt::print("  {}\n", sentence);
}

std::string shown_steps(const RunCost& cost) {
  const char* const early = cost.may_end_early ? "; an event may end the run early" : "";
  if (cost.fixed_steps) return fmt::format("{:.0f}, fixed{}", cost.steps.most, early);
  if (cost.may_creep)
    return fmt::format("about {:.0f} without vibrations, {:.2g} with vibrations that last{}", cost.steps.least,
                       cost.steps.most, early);
  return fmt::format("{:.0f} to {:.0f}, adaptive: {}{}", cost.steps.least, cost.steps.most,
                     cost.has_contact ? "small during contact; the number of contacts is not known in advance"
                                      : "accurate to an order of magnitude",
                     early);
}

// "2500 rows of tables, 5.6 ms each; 100 frames, 8 ms each".
std::string shown_outputs(const RunCost& cost) {
  const std::string rows = cost.rows.least == cost.rows.most ? fmt::format("{:.0f} rows of tables", cost.rows.most)
                                                             : "a row of tables each step";
  return fmt::format("{}, {:.3g} ms each; {:.0f} frames, {:.3g} ms each", rows, 1e3 * cost.row, cost.frames,
                     1e3 * cost.frame);
}

// Prints times on this machine under its present load.
void print_time(const Setup& setup, const RunCost& cost) {
  fmt::print("time, measured on this machine\n");
  if (cost.factor) fmt::print("  factorisation {:.3g} s, solution {:.3g} s\n", *cost.factor, *cost.solve);
  else if (!setup.integrator || setup.integrator->factor_bytes() > 0)
    fmt::print("  without factorisations: they are not measured\n");
  if (!setup.scene.buckling && !setup.scene.harmonic) {
    fmt::print("  {}steps {}\n", setup.integrator ? "" : "load ", shown_steps(cost));
    fmt::print("  of {} each\n", shown_seconds(cost.step));
    fmt::print("  outputs {}\n", shown_outputs(cost));
  }
  const CostRange all = cost.seconds();
  if (cost.may_creep)
    fmt::print("  in all {:.2g} s without vibrations, {:.2g} s with vibrations that last\n", all.least, all.most);
  else fmt::print("  in all {}\n", shown_seconds(all));
}

void print_faster(const Setup& setup, const RunCost& cost) {
  const auto way = faster_setup(setup, cost);
  if (!way || !way->pays()) return;
  fmt::print("faster\n  with {} (chooses {}): about {:.2g} s instead of {:.2g} s\n", fmt::join(way->changes, " and "),
             way->method, way->then, way->now);
  if (way->error)
    fmt::print("  linear kinematics would change the motion by about {:.1g} of its size; a run estimates this error\n",
               *way->error);
}

void print_disk(const Setup& setup) {
  const OutputSize size = output_size_of(setup);
  fmt::print("disk\n");
  if (setup.scene.harmonic) {
    fmt::print("  a row of response.csv for each frequency, and a shape for each mode\n");
    return;
  }
  fmt::print("  {}{:.0f} frames of {}\n", setup.integrator || setup.scene.buckling ? "" : "at least ", size.frames,
             shown_bytes(size.frame_bytes));
  if (size.rows > 0) fmt::print("  {:.0f} rows of tables of {}\n", size.rows, shown_bytes(size.row_bytes));
  else fmt::print("  a row of tables of {} each step\n", shown_bytes(size.row_bytes));
  if (size.checkpoint_bytes > 0) fmt::print("  checkpoint {}\n", shown_bytes(size.checkpoint_bytes));
  std::error_code error;
  const auto space = fs::space(".", error);
  fmt::print(
      "  in all {}{}\n", shown_bytes(size.bytes()),
      error ? "" : fmt::format("; {} are free in this folder", shown_bytes(static_cast<double>(space.available))));
  if (const std::string refusal = output_size_error(setup); !refusal.empty())
    fmt::print(stderr, "warning: {}\n", refusal);
}

}  // namespace

void print_predicted_cost(const Setup& setup, bool has_time) {
  const auto costs = term_costs(*setup.built.model, setup.built.initial, kMeasuringSeconds);
  const RunCost run = run_cost(setup, costs);
  print_time(setup, run);
  if (has_time) print_faster(setup, run);
  print_disk(setup);
  print_term_costs(setup, costs);
}

void warn_of_memory(const Setup& setup) {
  const auto needed = setup.integrator ? static_cast<double>(setup.integrator->factor_bytes()) : 0;
  if (const double left = memory_left(); needed > left)
    fmt::print(stderr,
               "warning: the factorisation needs {} of memory, {} are available: the run will be refused; use a "
               "coarser mesh or an explicit integrator\n",
               shown_bytes(needed), shown_bytes(left));
}

}  // namespace orthodyn
