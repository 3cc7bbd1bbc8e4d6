// `orthodyn check`: what a scene consists of and what it will cost, without running it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "lib/analysis/strain_limits.h"
#include "lib/core/memory.h"
#include "lib/core/symmetric_eigen.h"
#include "lib/material_axes/axes_source.h"
#include "lib/simulation/output/axes_file.h"
#include "lib/simulation/output/output_size.h"
#include "lib/simulation/preflight/faster_setup.h"
#include "lib/simulation/preflight/run_cost.h"
#include "lib/simulation/preflight/scene_cost.h"
#include "lib/simulation/preflight/thickness_check.h"
#include "lib/simulation/statics/static_problem.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/draw.h"
#include "tools/orthodyn/scene_options.h"
#include "tools/orthodyn/shortened.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

constexpr double kSecondsOfCosts = 1;  // in which terms are measured

struct CheckArguments : SceneArguments {
  bool axes = false;  // write the material axes
  std::optional<std::string> out;
};

double mebibytes(std::size_t bytes) { return static_cast<double>(bytes) / (1024 * 1024); }

std::string side(const std::optional<StrainLimit>& limit, int axis, const char* otherwise) {
  if (!limit) return otherwise;
  return fmt::format("{:+.3g} % ({})", 100 * limit->strain, describe(*limit, axis));
}

// Where the corotational law gives way, by the axis along which it is strained.
void print_strain_limits(const Stiffness& stiffness) {
  const auto limits = strain_limits(stiffness);
  for (int axis = 0; axis < 3; ++axis) {
    const auto& [compression, tension] = limits[static_cast<std::size_t>(axis)];
    fmt::print("    strain along axis {} from {} to {}\n", axis + 1, side(compression, axis, "-100 %"),
               side(tension, axis, "any"));
  }
}

void print_materials(const Scene& scene, bool is_linear) {
  for (const auto& [name, material] : scene.materials) {
    const Mat6 C = voigt(material->stiffness());
    const Vec6 lambda = symmetric_eigenvalues(C);
    fmt::print("  {}: density {} kg/m^3, eigenvalues of C {:.4g} Pa\n", name, material->density(),
               fmt::join(lambda, ", "));
    if (!is_linear) print_strain_limits(material->stiffness());
  }
}

// `solver_bytes` without its factorisation.
void print_memory(const FemModel& model, const std::string& solver, std::size_t solver_bytes,
                  std::size_t factor_bytes) {
  std::size_t sum = 0;
  fmt::print("memory\n");
  const auto line = [&](const std::string& name, std::size_t bytes) {
    fmt::print("  {:<20} {:8.2f} MiB\n", name, mebibytes(bytes));
    sum += bytes;
  };
  for (const auto& [name, bytes] : model.memory()) line(name, bytes);
  if (solver_bytes > 0) line(solver, solver_bytes);
  const auto cells = static_cast<double>(model.parts().mesh.tets.size());
  fmt::print("  {:<20} {:8.2f} MiB, {:.0f} bytes per element\n", "without factor", mebibytes(sum),
             static_cast<double>(sum) / cells);
  if (factor_bytes > 0) line("factorisation", factor_bytes);
}

// s, of central_differences: 2/omega (sqrt(1 + 4 xi^2) - 2 xi), xi by damping of the stiffness.
double critical_step(const FemModel& model) {
  double beta = 0;
  for (const auto& term : model.parts().elastic) beta = std::max(beta, term->definition().beta);
  const double omega = model.frequency_bound(), xi = beta * omega / 2;
  return 2 / omega / (std::sqrt(1 + 4 * xi * xi) + 2 * xi);
}

void print_dynamics(Setup& setup) {
  const FemModel& model = *setup.built.model;
  setup.integrator->start(setup.built.initial);
  fmt::print("  critical step of an explicit scheme at least {:.4g} s\n", critical_step(model));
  const auto breakpoints = model.breakpoints(setup.scene.time.start, setup.scene.time.end);
  if (!breakpoints.empty())
    fmt::print("  restarts at kinks of loads and motions: {} s\n", fmt::join(breakpoints, ", "));
  if (setup.scene.start == Start::equilibrium)
    fmt::print("start\n  from the static equilibrium, displaced by at most {:.4g} m\n",
               setup.built.initial.q.lpNorm<Eigen::Infinity>());
  fmt::print("integrator\n  type {}\n", setup.config.at("integrator").at("type").text());
  for (const auto& [key, value] : setup.integrator->decisions()) fmt::print("  {} {}\n", key, shortened(value));
  print_memory(model, "integrator", setup.integrator->bytes(), setup.integrator->factor_bytes());
}

void print_statics(const Setup& setup, const StaticProblem& problem) {
  fmt::print("statics\n  all rigid motions are held\n  solver {}\n", problem.solver->description());
  fmt::print("  loads at t = {:.6g} s, the largest {:.4g} N on a coordinate\n", problem.path->times().end,
             problem.path->largest_load());
  print_memory(*setup.built.model, "", 0, problem.solver->factor_bytes());
}

void print_supports(const FemModel& model) {
  const auto& parts = model.parts();
  const auto coordinates = 3 * parts.mesh.nodes.size();
  const auto moved = parts.moved ? parts.moved->num_coordinates() : 0;
  const auto held = coordinates - static_cast<std::size_t>(model.num_dofs()) - moved;
  fmt::print("clamps\n");
  if (held == 0) fmt::print("  none{}\n", moved > 0 ? "" : ": the body is free");
  else fmt::print("  {} of {} coordinates are held\n", held, coordinates);
  if (moved > 0) fmt::print("motions\n  {} of {} coordinates are moved\n", moved, coordinates);
}

void print_cost(const Setup& setup, const std::vector<TermCost>& costs) {
  TermCost all;
  for (const TermCost& cost : costs) all = {"", all.force + cost.force, all.tangent + cost.tangent};
  fmt::print("cost of one evaluation, measured\n");
  for (const TermCost& cost : costs)
    fmt::print("  {:<32} force {:9.4g} ms ({:3.0f} %), tangent {:9.4g} ms ({:3.0f} %)\n", cost.name, 1e3 * cost.force,
               100 * cost.force / all.force, 1e3 * cost.tangent, 100 * cost.tangent / all.tangent);
  const auto sentences = dispensable(setup, costs);
  fmt::print("could be left out at an accuracy of {:.0e}\n", accuracy_asked_for(setup.scene));
  if (sentences.empty()) fmt::print("  nothing, as far as the linear response shows\n");
  for (const auto& sentence : sentences) fmt::print("  {}\n", sentence);
}

std::string shown_steps(const RunCost& cost) {
  const char* const early = cost.may_end_early ? "; an event may end the run before its time" : "";
  if (cost.fixed_steps) return fmt::format("{:.0f}, as given{}", cost.steps.most, early);
  return fmt::format("{:.0f} to {:.0f}, chosen as it goes: {}{}", cost.steps.least, cost.steps.most,
                     cost.has_contact ? "small while the body touches the ground, and the number of contacts is not "
                                        "known in advance"
                                      : "right to an order of magnitude",
                     early);
}

// "2500 rows of tables, 5.6 ms each; 100 frames, 8 ms each".
std::string shown_outputs(const RunCost& cost) {
  const std::string rows = cost.rows.least == cost.rows.most ? fmt::format("{:.0f} rows of tables", cost.rows.most)
                                                             : "a row of tables each step";
  return fmt::format("{}, {:.3g} ms each; {:.0f} frames, {:.3g} ms each", rows, 1e3 * cost.row, cost.frames,
                     1e3 * cost.frame);
}

// Of this machine, as it is used now.
void print_time(const Setup& setup, const RunCost& cost) {
  fmt::print("time, from what was measured here\n");
  if (cost.factor) fmt::print("  factorisation {:.3g} s, solution {:.3g} s\n", *cost.factor, *cost.solve);
  else if (!setup.integrator || setup.integrator->factor_bytes() > 0)
    fmt::print("  without factorisations, which are not measured here\n");
  if (!setup.scene.buckling) {
    fmt::print("  {}steps {}\n", setup.integrator ? "" : "load ", shown_steps(cost));
    fmt::print("  of {} each\n", shown_seconds(cost.step));
    fmt::print("  outputs {}\n", shown_outputs(cost));
  }
  fmt::print("  in all {}\n", shown_seconds(cost.seconds()));
}

void print_faster(const Setup& setup, const RunCost& cost) {
  const auto way = faster_way(setup, cost);
  if (!way || !way->pays()) return;
  fmt::print("faster\n  with {} (which takes {}): about {:.2g} s in place of {:.2g} s\n",
             fmt::join(way->changes, " and "), way->method, way->then, way->now);
  if (way->error)
    fmt::print("  linear kinematics would be off by about {:.1g} of the motion; a run tells how far they are\n",
               *way->error);
}

void print_disk(const Setup& setup) {
  const OutputSize size = output_size_of(setup);
  fmt::print("disk\n");
  fmt::print("  {}{:.0f} frames of {}\n", setup.integrator || setup.scene.buckling ? "" : "at least ", size.frames,
             shown_bytes(size.frame_bytes));
  if (size.rows > 0) fmt::print("  {:.0f} rows of tables of {}\n", size.rows, shown_bytes(size.row_bytes));
  else fmt::print("  a row of tables of {} each step\n", shown_bytes(size.row_bytes));
  if (size.checkpoint_bytes > 0) fmt::print("  checkpoint {}\n", shown_bytes(size.checkpoint_bytes));
  std::error_code error;
  const auto space = fs::space(".", error);
  fmt::print("  in all {}{}\n", shown_bytes(size.bytes()),
             error ? "" : fmt::format("; {} are free here", shown_bytes(static_cast<double>(space.available))));
  if (const std::string refusal = unusual_output_size(setup); !refusal.empty())
    fmt::print(stderr, "warning: {}\n", refusal);
}

void warn_of_memory(const Setup& setup) {
  const auto needed = setup.integrator ? static_cast<double>(setup.integrator->factor_bytes()) : 0;
  if (const double left = memory_left(); needed > left)
    fmt::print(stderr,
               "warning: the factorisation takes {} of memory, and {} are left: the run will be refused; use a "
               "coarser mesh, or an explicit integrator\n",
               shown_bytes(needed), shown_bytes(left));
}

// "cylindrical, by place", for each region of the mesh by its name.
void print_axes(const Setup& setup) {
  fmt::print("axes\n");
  const Config regions = setup.config.at("regions");
  for (const auto& [name, region] : setup.scene.regions)
    fmt::print("  region {}: {}, {}\n", name, regions.at(name).at("axes").at("type").text(),
               region.axes->uniform() ? "one for all elements" : "by place");
}

// Has a picture drawn from them, too.
void write_and_draw_axes(const Setup& setup, const fs::path& folder) {
  const fs::path file = folder / "axes.vtu";
  write_axes(file, *setup.built.model);
  fmt::print("axes    {}\n", file.string());
  draw_axes(file);
}

int check(const CheckArguments& arguments) {
  auto [setup, has_time] = set_up_without_time(arguments.scene, arguments.changes);
  const FemModel& model = *setup.built.model;
  const auto& parts = model.parts();
  std::optional<StaticProblem> statics;  // refuses bodies that nothing holds
  if (!setup.integrator) statics.emplace(static_problem(setup.scene, setup.built));
  fmt::print("{}: valid{}\n", arguments.scene, has_time ? "" : ", except for the missing 'time'");
  fmt::print("mesh\n  {} nodes, {} elements, regions {}\n", parts.mesh.nodes.size(), parts.mesh.tets.size(),
             join(parts.mesh.region_names));
  const Box box = bounding_box(parts.mesh);
  fmt::print("  extent {} to {} m, mass {:.6g} kg ({})\n", Value<Vec3>::yaml(box.min), Value<Vec3>::yaml(box.max),
             parts.mass->total(), parts.mass->lumped() ? "lumped" : "consistent");
  for (const auto& sentence : thin_regions(parts.mesh)) fmt::print(stderr, "warning: {}\n", sentence);
  fmt::print("materials\n");
  print_materials(setup.scene, setup.built.model->traits().linear);
  print_axes(setup);
  print_supports(model);
  fmt::print("terms\n");
  for (const auto& term : parts.elastic) fmt::print("  {}\n", term->description());
  for (const auto& term : parts.loads) fmt::print("  {}\n", term->description());
  if (parts.mass_damping > 0) fmt::print("  mass-proportional damping of {:.6g} 1/s\n", parts.mass_damping);
  fmt::print("system\n  {} unknowns, {} non-zeros ({})\n", model.num_dofs(), model.pattern().non_zeros(),
             model.pattern().symmetric ? "symmetric, lower triangle" : "general");
  statics ? print_statics(setup, *statics) : print_dynamics(setup);
  warn_of_memory(setup);
  if (has_time || !setup.integrator) {
    const auto costs = term_costs(model, setup.built.initial, kSecondsOfCosts);
    const RunCost run = run_cost(setup, costs);
    print_time(setup, run);
    if (has_time) print_faster(setup, run);
    print_disk(setup);
    print_cost(setup, costs);
  }
  if (arguments.axes)
    write_and_draw_axes(
        setup, arguments.out ? fs::path(*arguments.out) : fs::path("out") / "axes" / fs::path(arguments.scene).stem());
  return 0;
}

void declare(CheckArguments& arguments, CommandOptions& options) {
  declare_scene(arguments, options);
  options.flag("--axes", arguments.axes, "Also write the material axes: axes.vtu and a picture, axes.png.");
  options.value("--out", arguments.out, "Folder for the axes; default out/axes/<scene>.").type("DIR").needs("--axes");
}

const CommandRegistration check_command(
    {.order = 20, .name = "check", .sentence = "Read, check and build a scene, and describe it.", .examples = R"(
  orthodyn check configs/scenes/laminate.yaml
  orthodyn check configs/scenes/laminate.yaml --axes)"},
    declare, check);

}  // namespace

}  // namespace orthodyn
