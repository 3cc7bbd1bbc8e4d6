// `orthodyn gradient`: the derivatives of one displacement, velocity or strain with respect to many numbers of a scene.
#include "lib/simulation/sensitivity/gradient.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "lib/simulation/output/files.h"
#include "lib/simulation/run/outcome.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/print_nothrow.h"
#include "tools/orthodyn/scene_options.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

struct GradientArguments {
  std::string scene, quantity;
  std::vector<std::string> set, paths;
  std::optional<std::string> at, out;
  bool quiet = false;
};

// With columns i, j, k of the cells if there are stiffness factors.
void write_table(const fs::path& file, const std::string& quantity, const Gradient& found) {
  const auto is_cell = [](const std::array<int, 3>& cell) { return cell[0] > 0; };
  const bool has_cells = std::ranges::any_of(found.cells, is_cell);
  std::string text = fmt::format("parameter,value [SI unit],d {} / d parameter [{} / SI unit]{}\n", quantity,
                                 found.unit, has_cells ? ",i,j,k" : "");
  for (std::size_t i = 0; i < found.parameters.size(); ++i) {
    text += fmt::format("{},{:.10g},{:.10g}", found.parameters[i].path(), found.parameters[i].value(),
                        found.derivatives[i]);
    if (is_cell(found.cells[i])) text += fmt::format(",{}", fmt::join(found.cells[i], ","));
    else if (has_cells) text += ",,,";
    text += "\n";
  }
  write_file(file, {text});
}

// The parameters with the largest effects: derivatives times a usual change.
void print_largest(const Gradient& found) {
  constexpr std::size_t kShown = 10;
  std::vector<std::size_t> order(found.parameters.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto effect = [&](std::size_t i) { return found.derivatives[i] * found.parameters[i].usual_change(); };
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return std::abs(effect(i)); });
  fmt::print("  {:44} {:>16}\n", "parameter", "change");
  for (std::size_t k = 0; k < std::min(kShown, order.size()); ++k)
    fmt::print("  {:44} {:>16} per {}\n", found.parameters[order[k]].path(),
               fmt::format("{:+.4g} {}", effect(order[k]), found.unit), found.parameters[order[k]].change_text());
  if (order.size() > kShown) fmt::print("  and {} parameters with smaller effects\n", order.size() - kShown);
}

// Prints a line every five seconds.
class Printer {
 public:
  void operator()(const GradientProgress& progress) {
    constexpr double kInterval = 5;  // s
    const auto now = Clock::now();
    if (std::chrono::duration<double>(now - told_).count() < kInterval) return;
    told_ = now;
    if (progress.stage == GradientProgress::Stage::equilibrium)
      print_nothrow(fmt::format("load factor {:.6g}\n", progress.at));
    else
      print_nothrow(fmt::format("{:3.0f} %  of the {}, t = {:.4g} s\n", 100 * progress.share,
                                progress.stage == GradientProgress::Stage::motion
                                    ? "motion"
                                    : "adjoint equations, which go back to the start",
                                progress.at));
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point told_ = Clock::now();
};

// Derivatives of motions: their error control, and how to see their errors.
void print_accuracy(const Gradient& found) {
  if (!found.rtol || found.adjoint_rtol == 0) return;
  fmt::print(
      "accuracy  rtol {:.2g} for the motion, {:.2g} for the adjoint equations, relative to the largest derivatives; "
      "repeat with a smaller integrator.rtol to see the error\n",
      *found.rtol, found.adjoint_rtol);
}

int compute_gradient(const GradientArguments& arguments) {
  const fs::path folder =
      arguments.out ? fs::path(*arguments.out) : fs::path("out") / "gradients" / fs::path(arguments.scene).stem();
  Config config = Config::from_file(arguments.scene);
  for (const std::string& assignment : arguments.set) config.override_with(assignment);
  GradientRequest request{arguments.quantity, {}, arguments.paths, {}};
  if (!arguments.quiet) request.on_progress = Printer();
  if (arguments.at) request.at = read_number(Config::from_text(*arguments.at, "--at"), {.unit = "s"});
  const double begin = cpu_seconds_now();
  const Gradient found = gradient(config.resolving(), request);
  const double seconds = cpu_seconds_now() - begin;
  fs::create_directories(folder);
  write_table(folder / "gradient.csv", arguments.quantity, found);
  if (arguments.quiet) return 0;
  fmt::print("{} = {:.6g} {}\n", arguments.quantity, found.value, found.unit);
  print_largest(found);
  if (found.forward_steps > 0)
    fmt::print("steps     {} forward, {} backward\n", found.forward_steps, found.backward_steps);
  print_accuracy(found);
  fmt::print("cost      {:.3g} s of CPU\ntable     {}\n", seconds, (folder / "gradient.csv").string());
  return 0;
}

void declare(GradientArguments& arguments, CommandOptions& options) {
  options.value("scene", arguments.scene, "A scene in YAML, static or a motion with cvode_bdf.")
      .required()
      .type("SCENE.yaml");
  options
      .value("--of", arguments.quantity,
             "The quantity: PROBE.displacement.z, PROBE.velocity.z, GAUGE.length or GAUGE.strain.")
      .required()
      .type("QUANTITY");
  options
      .repeated("--by", arguments.paths,
                "A number of the scene, such as materials.spruce.young.0. The path of a region's stiffness_factors "
                "stands for the factors of all cells.")
      .type("PATH");
  options.value("--at", arguments.at, "Time of the quantity, such as 0.2 s; default the end of the motion.")
      .type("TIME");
  options.value("--out", arguments.out, "Folder for gradient.csv; default out/gradients/<scene>.").type("DIR");
  options.flag("--quiet", arguments.quiet, "Write the table only.");
  options.repeated("--set", arguments.set, "Change a value of the scene by its path.").type("PATH=VALUE");
}

const CommandRegistration gradient_command(
    {.order = 31,
     .name = "gradient",
     .sentence =
         "Compute the derivatives of a displacement or strain with respect to many numbers of a scene, by adjoint "
         "equations.",
     .examples = R"(
  orthodyn gradient beam.yaml --of tip.displacement.z --by regions.body.stiffness_factors
  orthodyn gradient motion.yaml --of tip.velocity.x --at 0.2 --by materials.wood.young.0 --by materials.wood.g12)"},
    declare, compute_gradient);

}  // namespace

}  // namespace orthodyn
