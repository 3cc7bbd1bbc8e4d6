// `orthodyn modes`: undamped natural frequencies and mode shapes about rest or a static equilibrium.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>

#include "lib/core/number_format.h"
#include "lib/simulation/modes/modal_analysis.h"
#include "lib/simulation/modes/mode_files.h"
#include "lib/simulation/sensitivity/frequency_sensitivity.h"
#include "lib/simulation/sensitivity/shape_sensitivity_files.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/draw.h"
#include "tools/orthodyn/scene_options.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

struct ModesArguments {
  std::string scene;
  std::vector<std::string> set, sensitivities;
  std::optional<std::string> out;
  int count = 20;
  bool equilibrium = false, shape_sensitivities = false, picture = false, quiet = false, force = false;
};

void print_zeros(const Modes& modes, int rigid) {
  if (rigid > 0) fmt::print("the first {} {} rigid: 0 Hz\n", rigid, rigid == 1 ? "is" : "are");
  if (const int more = modes.zeros - rigid; more > 0)
    fmt::print("{} {} cannot be distinguished from zero: round-off hides frequencies below {:.2g} Hz of this mesh{}\n",
               rigid > 0 ? fmt::format("{} more", more) : fmt::format("the first {}", more),
               more == 1 ? "mode" : "modes", modes.resolution,
               rigid > 0 ? "" : "; the body is held, none of them is rigid");
}

// Relative mesh error of a frequency, positive if the frequency is too high; "" for 0.
std::string mesh_error_text(const ModalAnalysis& analysis, std::size_t mode) {
  const double error = analysis.mesh_errors()[mode];
  return error == 0 ? "" : fmt::format("{:+.2g} %", 100 * error);
}

void print_table(const ModalAnalysis& analysis, bool equilibrium) {
  const FemModel& model = analysis.model();
  const Modes& modes = analysis.modes();
  const double mass = model.parts().mass->total();
  fmt::print("natural modes about {}, {} mass, without damping: {} of {}\n", equilibrium ? "equilibrium" : "rest",
             model.parts().mass->lumped() ? "lumped" : "consistent", modes.modes.size(), model.num_dofs());
  fmt::print("solver  {}\n", modes.solver);
  print_zeros(modes, analysis.rigid());
  fmt::print("  mode  frequency [Hz]   mesh error   effective mass along x, y, z [% of {:.4g} kg]   residual\n", mass);
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < modes.modes.size(); ++k) {
    const Vec3 share = 100 * modes.modes[k].effective_mass() / mass;
    sum += share;
    fmt::print("  {:4}  {:>14}  {:>11}   {:12.3f} {:12.3f} {:12.3f}   {:18.1e}\n", k + 1,
               known_digits(modes.modes[k].frequency(), analysis.mesh_errors()[k]), mesh_error_text(analysis, k),
               share[0], share[1], share[2], modes.modes[k].residual);
  }
  fmt::print("  {:4}  {:>14}  {:11}   {:12.3f} {:12.3f} {:12.3f}\n", "", "sum", "", sum[0], sum[1], sum[2]);
  if (modes.modes.front().lambda < 0)
    fmt::print("negative frequencies: the state is unstable; the motion grows as exp(|angular_frequency| t)\n");
}

void print_mesh_errors(const ModalAnalysis& analysis) {
  const FrequencyErrors& errors = analysis.frequency_errors();
  fmt::print("mesh errors estimated from {}\n",
             errors.by_finer_elements ? fmt::format("finer elements, in {:.2g} s of CPU", errors.cpu_seconds)
                                      : std::string("recovered stresses"));
  const int order = analysis.model().parts().mesh.order();
  for (const std::string& warning : {frequency_warning(errors, order), locking_warning(errors.locking_risk)})
    if (!warning.empty()) fmt::print(stderr, "warning: {}\n", warning);
}

// Slope of each frequency: its change in % per usual change of the parameter.
void print_sensitivities(const Modes& modes, const std::vector<FrequencySensitivity>& all) {
  if (all.empty()) return;
  fmt::print("sensitivities: slope of the frequency, in % per change of the parameter\n  mode");
  for (const FrequencySensitivity& one : all)
    fmt::print("  {}", fmt::format("{} + {}", one.parameter.path(), one.parameter.change_text()));
  fmt::print("\n");
  for (auto k = static_cast<std::size_t>(modes.zeros); k < modes.modes.size(); ++k) {
    fmt::print("  {:4}", k + 1);
    for (const FrequencySensitivity& one : all) {
      const std::size_t width = one.parameter.path().size() + 3 + std::string(one.parameter.change_text()).size();
      const double change = 100 * one.derivatives[k] * one.parameter.usual_change() / modes.modes[k].frequency();
      fmt::print("  {:>{}}", std::isfinite(change) ? fmt::format("{:+.4f}", change) : "-", width);
    }
    fmt::print("\n");
  }
}

// Modes whose shapes have no derivatives, with the reasons; not the rigid ones.
void print_missing_shapes(const ModalAnalysis& analysis, const ShapeSensitivities& sensitivities) {
  for (auto k = static_cast<std::size_t>(analysis.modes().zeros); k < sensitivities.missing.size(); ++k)
    if (!sensitivities.missing[k].empty())
      fmt::print("the shape of mode {} has no derivative: {}\n", k + 1, sensitivities.missing[k]);
}

int compute_modes(const ModesArguments& arguments) {
  const fs::path folder =
      arguments.out ? fs::path(*arguments.out) : fs::path("out") / "modes" / fs::path(arguments.scene).stem();
  check_modes_folder(folder, arguments.force);
  if (arguments.equilibrium && !arguments.sensitivities.empty())
    throw ConfigError("--sensitivity", "is available for modes about rest only; leave out --equilibrium");
  if (arguments.shape_sensitivities && arguments.sensitivities.empty())
    throw ConfigError("--shape-sensitivities", "needs a number of the scene: add --sensitivity PATH");
  const Setup setup = set_up_without_time(arguments.scene, {.set = arguments.set}, false).setup;
  const auto parameters = scene_parameters(setup.config, arguments.sensitivities);
  const ModalAnalysis analysis(setup, arguments.count, arguments.equilibrium);
  write_modes(folder, analysis);
  const auto sensitivities = frequency_sensitivities(setup.config, analysis, parameters);
  write_sensitivities(folder, analysis, sensitivities);
  ShapeSensitivities of_shapes;
  if (arguments.shape_sensitivities) {
    of_shapes = shape_sensitivities(setup.config, analysis.model(), analysis.about(), analysis.modes(), parameters);
    write_shape_sensitivities(folder, setup.scene, analysis, of_shapes);
  }
  if (arguments.quiet) return 0;
  const Modes& modes = analysis.modes();
  print_table(analysis, arguments.equilibrium);
  print_mesh_errors(analysis);
  print_sensitivities(modes, sensitivities);
  print_missing_shapes(analysis, of_shapes);
  if (analysis.takes_symmetric_part())
    fmt::print(stderr,
               "warning: a load that follows the body makes the stiffness unsymmetric; modes use its symmetric part "
               "and do not show flutter. Run a motion (analysis: dynamic) to see it\n");
  if (analysis.model().internal_variables())
    fmt::print(stderr,
               "warning: the frequencies are those of the relaxed stiffness of viscoelastic materials; for resonances, "
               "whose stiffness depends on the frequency, use analysis: harmonic\n");
  fmt::print("results {}\n", folder.string());
  if (modes.zeros >= arguments.count)
    fmt::print("no shapes to draw: all {} modes {}; compute more with -n\n", modes.zeros,
               analysis.rigid() == modes.zeros ? "are rigid" : "are at 0 Hz");
  else if (arguments.picture) draw_modes(folder);
  else fmt::print("to see the shapes: orthodyn view {}, or --picture\n", folder.string());
  return 0;
}

void declare(ModesArguments& arguments, CommandOptions& options) {
  options.value("scene", arguments.scene, "A scene in YAML.").required().type("SCENE.yaml");
  options.value("-n,--count", arguments.count, "Number of modes, lowest first, including rigid ones.")
      .range(1, 1000000)
      .show_default();
  options.flag("--equilibrium", arguments.equilibrium,
               "Compute modes about the static equilibrium under the scene's loads instead of about rest.");
  options
      .repeated("--sensitivity", arguments.sensitivities,
                "Also compute the derivative of each frequency with respect to this number of the scene, such as "
                "materials.spruce.young.0.")
      .type("PATH");
  options.flag("--shape-sensitivities", arguments.shape_sensitivities,
               "Also compute the derivative of each shape with respect to each --sensitivity.");
  options.value("--out", arguments.out, "Folder for the results; default out/modes/<scene>.").type("DIR");
  options.flag("--force", arguments.force, "Replace earlier results in the folder.");
  options.flag("--picture", arguments.picture, "Also draw the shapes in modes.png, which takes some seconds.");
  options.flag("--quiet", arguments.quiet, "Write results only: no table and no picture.");
  options.repeated("--set", arguments.set, "Change a value of the scene by its path.").type("PATH=VALUE");
}

const CommandRegistration modes_command(
    {.order = 30, .name = "modes", .sentence = "Compute undamped natural frequencies and mode shapes.", .examples = R"(
  orthodyn modes configs/scenes/tuning_fork.yaml -n 8
  orthodyn modes part.yaml --sensitivity materials.wood.young.0 --sensitivity materials.wood.density)"},
    declare, compute_modes);

}  // namespace

}  // namespace orthodyn
