// `orthodyn check`: validates and describes a scene, and predicts the cost of its run.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "lib/analysis/strain_limits.h"
#include "lib/core/memory.h"
#include "lib/core/symmetric_eigen.h"
#include "lib/linear/solver.h"
#include "lib/material_axes/axes_source.h"
#include "lib/scene/added_laws.h"
#include "lib/simulation/output/setup_file.h"
#include "lib/simulation/preflight/output_size.h"
#include "lib/simulation/preflight/thickness_check.h"
#include "lib/simulation/statics/static_problem.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/draw.h"
#include "tools/orthodyn/predicted_cost.h"
#include "tools/orthodyn/run_summary.h"
#include "tools/orthodyn/scene_options.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

struct CheckArguments : SceneArguments {
  bool axes = false;
  std::optional<std::string> out;
};

double mebibytes(std::size_t bytes) { return static_cast<double>(bytes) / (1024 * 1024); }

std::string side(const std::optional<StrainLimit>& limit, int axis, const char* otherwise) {
  if (!limit) return otherwise;
  return fmt::format("{:+.3g} % ({})", 100 * limit->strain, describe(*limit, axis));
}

// Prints the strains along each material axis at which the corotational law loses strong ellipticity.
void print_strain_limits(const Stiffness& stiffness) {
  const auto limits = strain_limits(stiffness);
  for (int axis = 0; axis < 3; ++axis) {
    const auto& [compression, tension] = limits[static_cast<std::size_t>(axis)];
    fmt::print("    strain along axis {} from {} to {}\n", axis + 1, side(compression, axis, "-100 %"),
               side(tension, axis, "any"));
  }
}

// Whether all regions of a material have another law than the corotational one.
bool is_replaced(const Scene& scene, const std::string& material) {
  bool is_used = false;
  for (const auto& [name, region] : scene.regions)
    for (const std::string& own : region.materials()) {
      if (own == material && region.law == ElasticLaw::corotational) return false;
      is_used = is_used || own == material;
    }
  return is_used;
}

void print_materials(const Scene& scene, bool is_linear) {
  for (const auto& [name, material] : scene.materials) {
    const Mat6 C = voigt(material->stiffness());
    const Vec6 lambda = symmetric_eigenvalues(C);
    fmt::print("  {}: density {} kg/m^3, eigenvalues of C {:.4g} Pa\n", name, material->density(),
               fmt::join(lambda, ", "));
    if (is_replaced(scene, name)) fmt::print("    law: neo_hookean, for any strain with det F > 0\n");
    else if (!is_linear) {
      print_strain_limits(material->stiffness());
      if (material->fibres()) fmt::print("    these limits are those of the matrix; its fibres bear no compression\n");
      if (is_viscoelastic(*material)) fmt::print("    these limits are those at once, before the stiffness relaxes\n");
    }
  }
}

// `solver_bytes`: memory of the solver without the factorisation.
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
  const auto cells = static_cast<double>(model.parts().mesh.cells.size());
  fmt::print("  {:<20} {:8.2f} MiB, {:.0f} bytes per element\n", "without factor", mebibytes(sum),
             static_cast<double>(sum) / cells);
  if (factor_bytes > 0) line("factorisation", factor_bytes);
}

// Stable step (s) of central_differences: 2/omega (sqrt(1 + 4 xi^2) - 2 xi) with xi = beta omega / 2, where omega
// (rad/s) bounds the natural frequencies and beta (s) is the largest stiffness-proportional damping.
double critical_step(const FemModel& model) {
  double beta = 0;
  for (const auto& term : model.parts().elastic) beta = std::max(beta, term->definition().beta);
  const double omega = model.frequency_bound(), xi = beta * omega / 2;
  return 2 / omega / (std::sqrt(1 + 4 * xi * xi) + 2 * xi);
}

void print_dynamics(Setup& setup) {
  const FemModel& model = *setup.built.model;
  setup.integrator->start(setup.built.initial);
  if (const double step = critical_step(model); std::isfinite(step))
    fmt::print("  critical step of an explicit scheme at least {:.4g} s\n", step);
  else
    fmt::print("  no critical step of an explicit scheme, as nothing is elastic: give central_differences a `step`\n");
  const auto breakpoints = model.breakpoints(setup.scene.time.start, setup.scene.time.end);
  if (!breakpoints.empty())
    fmt::print("  restarts at kinks of loads and motions: t = {} s\n", fmt::join(breakpoints, ", "));
  if (setup.scene.start == Start::equilibrium)
    fmt::print("start\n  from the static equilibrium, displaced by at most {:.4g} m\n",
               setup.built.initial.q.lpNorm<Eigen::Infinity>());
  fmt::print("integrator\n  type {}\n", setup.config.at("integrator").at("type").text());
  for (const auto& [key, value] : setup.integrator->decisions()) fmt::print("  {} {}\n", key, rounded_number(value));
  print_memory(model, "integrator", setup.integrator->bytes(), setup.integrator->factor_bytes());
}

void print_statics(const Setup& setup, const StaticProblem& problem) {
  fmt::print("statics\n  all rigid motions are held\n  solver {}\n", problem.solver->description());
  fmt::print("  loads at t = {:.6g} s, the largest component {:.4g} N\n", problem.path->times().end,
             problem.path->largest_load());
  print_memory(*setup.built.model, "", 0, problem.solver->factor_bytes());
}

void print_harmonic(const Setup& setup) {
  const Harmonic& harmonic = *setup.scene.harmonic;
  fmt::print("harmonic\n");
  if (harmonic.frequencies) fmt::print("  {}", fmt::format("{} given frequencies", harmonic.frequencies->size()));
  else
    fmt::print("  {} frequencies{}", harmonic.points.value_or(200),
               harmonic.resonances.value_or(true) ? " and those beside resonances" : "");
  fmt::print(" from {:.6g} to {:.6g} Hz\n", harmonic.lowest(), harmonic.highest());
  if (harmonic.damping_ratio > 0) fmt::print("  damping ratio {:.4g} of each mode\n", harmonic.damping_ratio);
  for (const auto& [material, loss] : harmonic.losses) fmt::print("  losses of {}\n", material);
  print_memory(*setup.built.model, "", 0, make_solver_for(setup.built.model->pattern())->factor_bytes());
}

// Whether joints, or terms that are no loads, such as springs and contact, may hold a body.
bool may_be_held(const FemModel::Parts& parts) {
  return std::any_of(parts.joints.begin(), parts.joints.end(),
                     [](const Joint& joint) { return joint.of == Joint::Of::bodies; }) ||
         std::any_of(parts.loads.begin(), parts.loads.end(), [](const auto& term) { return !term->is_load(); });
}

void print_supports(const FemModel& model) {
  const auto& parts = model.parts();
  const auto coordinates = 3 * (parts.mesh.nodes.size() - parts.dofs->ties().nodes().size());
  const auto moved = parts.moved ? parts.moved->num_coordinates() : 0;
  const auto held = coordinates - static_cast<std::size_t>(model.num_dofs()) - moved;
  fmt::print("clamps\n");
  if (held == 0) fmt::print("  none{}\n", moved > 0 || may_be_held(parts) ? "" : ": the body is free");
  else fmt::print("  {} of {} coordinates are held\n", held, coordinates);
  if (moved > 0) fmt::print("motions\n  {} of {} coordinates are moved\n", moved, coordinates);
}

// `extent`: of the mesh, m. Coordinates far below it are round-off.
std::string point_text(const Vec3& point, double extent) {
  const Vec3 x = (point.array().abs() > 1e-9 * extent).select(point, 0);
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", x[0], x[1], x[2]);
}

void print_rigid_body(const RigidBody& body, double extent) {
  const RigidInertia& inertia = body.inertia;
  const Vec3 J = inertia.principal_moments();
  fmt::print("  {}: {} nodes, {}\n", body.name, body.nodes().size(), body.is_held ? "held" : "free");
  fmt::print("    mass {:.6g} kg, centre {} m, principal moments {:.4g}, {:.4g}, {:.4g} kg m^2\n", inertia.mass,
             point_text(inertia.center, extent), J[0], J[1], J[2]);
}

void print_connections(const FemModel& model) {
  const auto& parts = model.parts();
  if (!parts.ties.empty()) fmt::print("ties\n");
  for (const NamedTie& tie : parts.ties) fmt::print("  {}: {} tied nodes\n", tie.name, tie.nodes.size());
  if (!parts.rigid_bodies.empty()) fmt::print("rigid bodies\n");
  for (const RigidBody& body : parts.rigid_bodies) print_rigid_body(body, bounding_box(parts.mesh).diagonal());
  const auto is_of_bodies = [](const Joint& joint) { return joint.of == Joint::Of::bodies; };
  if (std::any_of(parts.joints.begin(), parts.joints.end(), is_of_bodies)) fmt::print("joints\n");
  for (const Joint& joint : parts.joints) {
    if (!is_of_bodies(joint)) continue;
    int constraints = 0;
    for (const JointEquation& equation : joint.equations) constraints += equation.size();
    fmt::print("  {}: {}\n", joint.name,
               constraints == 0 ? "a strut, no constraints" : counted(constraints, "constraint"));
  }
}

// Prints the axes of each region: "cylindrical, varies with position".
void print_axes(const Setup& setup) {
  fmt::print("axes\n");
  const Config regions = setup.config.at("regions");
  for (const auto& [name, region] : setup.scene.regions)
    fmt::print("  region {}: {}, {}\n", name, regions.at(name).at("axes").at("type").text(),
               region.axes->uniform() ? "the same for all elements" : "varies with position");
}

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
  std::optional<StaticProblem> statics;  // throws for a body with rigid motions
  if (!setup.integrator && !setup.scene.harmonic) statics.emplace(static_problem(setup.scene, setup.built));
  fmt::print("{}: valid{}\n", arguments.scene, has_time ? "" : ", except for the missing 'time'");
  fmt::print("mesh\n  {} nodes, {}, regions {}\n", parts.mesh.nodes.size(), describe_cells(parts.mesh.cells),
             join(parts.mesh.region_names));
  const Box box = bounding_box(parts.mesh);
  fmt::print("  extent {} to {} m, mass {:.6g} kg ({})\n", point_text(box.min, box.diagonal()),
             point_text(box.max, box.diagonal()), parts.mass->total(), parts.mass->lumped() ? "lumped" : "consistent");
  for (const auto& sentence : thin_regions(parts)) fmt::print(stderr, "warning: {}\n", sentence);
  fmt::print("materials\n");
  print_materials(setup.scene, setup.built.model->traits().linear);
  print_axes(setup);
  print_supports(model);
  print_connections(model);
  fmt::print("terms\n");
  for (const std::string& description : term_descriptions(parts)) fmt::print("  {}\n", description);
  if (parts.mass_damping > 0) fmt::print("  mass-proportional damping of {:.6g} 1/s\n", parts.mass_damping);
  fmt::print("system\n  {} unknowns, {} non-zeros ({})\n", model.num_dofs(), model.pattern().non_zeros(),
             model.pattern().symmetric ? "symmetric, lower triangle" : "general");
  if (setup.scene.harmonic) print_harmonic(setup);
  else if (statics) print_statics(setup, *statics);
  else print_dynamics(setup);
  warn_of_memory(setup);
  if (has_time || !setup.integrator) print_predicted_cost(setup, has_time);
  if (arguments.axes)
    write_and_draw_axes(
        setup, arguments.out ? fs::path(*arguments.out) : fs::path("out") / "axes" / fs::path(arguments.scene).stem());
  return 0;
}

void declare(CheckArguments& arguments, CommandOptions& options) {
  declare_scene(arguments, options);
  options.flag("--axes", arguments.axes, "Also write the material axes as axes.vtu, and draw them in axes.png.");
  options.value("--out", arguments.out, "Folder for --axes; default out/axes/<scene>.").type("DIR").needs("--axes");
}

const CommandRegistration check_command(
    {.order = 20,
     .name = "check",
     .sentence = "Check a scene without running it: errors, warnings, model, predicted time and disk usage.",
     .examples = R"(
  orthodyn check configs/scenes/laminate.yaml
  orthodyn check configs/scenes/laminate.yaml --axes)"},
    declare, check);

}  // namespace

}  // namespace orthodyn
