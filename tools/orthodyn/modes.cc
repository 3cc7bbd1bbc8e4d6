// `orthodyn modes`: natural frequencies and shapes of a scene's body about rest or equilibrium, without damping.
#include "lib/analysis/modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "lib/analysis/rigid_freedom.h"
#include "lib/core/errors.h"
#include "lib/simulation/equilibrium.h"
#include "lib/simulation/vtu.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/draw.h"
#include "tools/orthodyn/setup.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

struct ModesArguments {
  std::string scene;
  std::vector<std::string> set;
  std::optional<std::string> out;
  int count = 20;
  bool equilibrium = false, quiet = false, force = false;
};

// What the modes are those of: the body with its supports standing still.
struct Resting {
  Scene scene;
  std::optional<BuiltScene> rebuilt;  // where the supports of the scene's own model move
};

Resting resting(const Setup& setup) {
  if (setup.scene.analysis == Analysis::statical) return {setup.scene, {}};
  Resting out{at_rest(setup.scene), {}};
  if (!out.scene.motions.empty()) out.rebuilt = build(out.scene);
  return out;
}

State state_about(const Setup& setup, const Scene& scene, const BuiltScene& built, bool equilibrium_asked) {
  const Vector zero = Vector::Zero(built.model->num_dofs());
  const double t = scene.time.end;
  if (!equilibrium_asked) return {t, zero, zero};
  if (scene.start == Start::equilibrium) return {t, setup.built.initial.q, zero};
  return {t, equilibrium(scene, built), zero};
}

// Throws ConfigError for a folder with anything in it, other than earlier modes that are to be replaced.
void check_folder(const fs::path& folder, bool replace) {
  std::error_code ec;
  if (!fs::exists(folder, ec)) return;
  if (!fs::is_directory(folder, ec))
    throw ConfigError(fmt::format("{}: is a file, expected a folder for the results; use --out", folder.string()));
  if (fs::is_empty(folder, ec)) return;
  if (!fs::exists(folder / "modes.csv", ec))
    throw ConfigError(fmt::format("{}: holds files that are no modes; use --out with another folder", folder.string()));
  if (!replace)
    throw ConfigError(fmt::format("{}: holds earlier modes; use --force to replace them, or --out with another folder",
                                  folder.string()));
}

void remove_earlier(const fs::path& folder) {
  std::error_code ec;
  for (const char* name : {"modes", "modes.pvd", "modes.png", "modes.log", "modes.csv"})
    if (!ec) fs::remove_all(folder / name, ec);
  if (ec) throw RunError(fmt::format("cannot prepare the folder {}: {}", folder.string(), ec.message()));
}

void write_csv(const fs::path& path, const Modes& modes) {
  CsvFile file(path, {"mode", "frequency [Hz]", "angular_frequency [rad/s]", "participation.x [sqrt(kg)]",
                      "participation.y [sqrt(kg)]", "participation.z [sqrt(kg)]", "effective_mass.x [kg]",
                      "effective_mass.y [kg]", "effective_mass.z [kg]", "residual"});
  file.begin();
  double number = 0;
  for (const auto& mode : modes.modes) {
    const Vec3 &p = mode.participation, m = mode.effective_mass();
    file.row({++number, mode.frequency(), mode.angular_frequency(), p[0], p[1], p[2], m[0], m[1], m[2], mode.residual});
  }
}

// The shape at all nodes, its largest displacement 1.
std::vector<double> nodal_shape(const Model& model, const State& about, const Vector& shape) {
  auto moved = model.evaluate("displacement", {about.t, about.q + shape, about.v});
  const auto before = model.evaluate("displacement", about);
  double largest = 0;
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] -= before[i];
  for (std::size_t i = 0; i < moved.size(); i += 3) largest = std::max(largest, Eigen::Map<const Vec3>(&moved[i]).norm());
  for (double& x : moved) x /= largest;
  return moved;
}

// modes.pvd, whose times are the modes' numbers, and a file per mode.
void write_shapes(const fs::path& folder, const Model& model, const State& about, const Modes& modes) {
  GrowingFile collection(folder / "modes.pvd",
                         "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n",
                         "</Collection>\n</VTKFile>\n");
  collection.begin();
  const Geometry geometry = model.geometry();
  const auto displacement = model.evaluate("displacement", about);
  for (std::size_t k = 0; k < modes.modes.size(); ++k) {
    const auto name = fmt::format("modes/mode_{:03}.vtu", k + 1);
    write_vtu(folder / name, geometry,
              {{"shape", Location::node, 3, nodal_shape(model, about, modes.modes[k].shape)},
               {"displacement", Location::node, 3, displacement}});
    collection.append(fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", k + 1, name));
  }
}

// Only what the geometry leaves free is rigid; round-off makes zeros of the softest modes of slender bodies, too.
void print_zeros(const Modes& modes, int rigid) {
  if (rigid > 0)
    fmt::print("the first {} {} rigid: 0 Hz, nothing holds them\n", rigid, rigid == 1 ? "is" : "are");
  if (const int more = modes.zeros - rigid; more > 0)
    fmt::print("{} {} cannot be told from zero: round-off hides what is below {:.2g} Hz of a mesh this stiff{}\n",
               rigid > 0 ? fmt::format("{} more", more) : fmt::format("the first {}", more),
               more == 1 ? "mode" : "modes", modes.resolution,
               rigid > 0 ? "" : "; the body is held, none of them is rigid");
}

void print_table(const FemModel& model, const Modes& modes, int rigid, bool equilibrium) {
  const double mass = model.parts().mass->total();
  fmt::print("natural modes about {}, {} mass, without damping: {} of {}\n", equilibrium ? "equilibrium" : "rest",
             model.parts().mass->lumped() ? "lumped" : "consistent", modes.modes.size(), model.num_dofs());
  print_zeros(modes, rigid);
  fmt::print("  mode  frequency [Hz]   effective mass along x, y, z [% of {:.4g} kg]   residual\n", mass);
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < modes.modes.size(); ++k) {
    const Vec3 share = 100 * modes.modes[k].effective_mass() / mass;
    sum += share;
    fmt::print("  {:4}  {:14.7g}   {:12.3f} {:12.3f} {:12.3f}   {:18.1e}\n", k + 1, modes.modes[k].frequency(), share[0],
               share[1], share[2], modes.modes[k].residual);
  }
  fmt::print("  {:4}  {:>14}   {:12.3f} {:12.3f} {:12.3f}\n", "", "sum", sum[0], sum[1], sum[2]);
  if (modes.modes.front().lambda < 0)
    fmt::print("negative frequencies: the state is unstable, motion grows at that rate (rad/s: angular_frequency)\n");
}

int compute_modes(const ModesArguments& arguments) {
  const fs::path folder =
      arguments.out ? fs::path(*arguments.out) : fs::path("out") / "modes" / fs::path(arguments.scene).stem();
  check_folder(folder, arguments.force);
  const Setup setup = set_up_and_warn(read_config(arguments.scene, std::nullopt, arguments.set));
  const Resting still = resting(setup);
  const BuiltScene& built = still.rebuilt ? *still.rebuilt : setup.built;
  const FemModel& model = *built.model;
  const State about = state_about(setup, still.scene, built, arguments.equilibrium);
  const Modes modes = natural_modes(model, about, arguments.count);
  const int rigid = modes.zeros > 0 ? std::min(modes.zeros, count_rigid_freedom(model, about.t)) : 0;
  remove_earlier(folder);
  write_csv(folder / "modes.csv", modes);
  write_shapes(folder, model, about, modes);
  if (arguments.quiet) return 0;
  print_table(model, modes, rigid, arguments.equilibrium);
  fmt::print("results {}\n", folder.string());
  if (modes.zeros < arguments.count) draw_modes(folder);
  else fmt::print("no picture: all {} modes {}; ask for more with -n\n", modes.zeros,
                  rigid == modes.zeros ? "are rigid" : "are at 0 Hz");
  return 0;
}

void declare(ModesArguments& arguments, CommandOptions& options) {
  options.value("scene", arguments.scene, "A scene in YAML.").required().type("SCENE.yaml");
  options.value("-n,--count", arguments.count, "How many, the lowest first, rigid ones included.")
      .range(1, 1000000)
      .show_default();
  options.flag("--equilibrium", arguments.equilibrium,
               "About the static equilibrium under the scene's loads, not about rest.");
  options.value("--out", arguments.out, "Folder for the results; default out/modes/<scene>.").type("DIR");
  options.flag("--force", arguments.force, "Replace earlier modes in the folder.");
  options.flag("--quiet", arguments.quiet, "No table and no picture.");
  options.repeated("--set", arguments.set, "Change a value by its path.").type("PATH=VALUE");
}

const CommandRegistration kRegistration(
    {.order = 30,
     .name = "modes",
     .sentence = "Natural frequencies and shapes of a scene's body, without damping.",
     .examples = R"(
  orthodyn modes configs/scenes/tuning_fork.yaml -n 8)"},
    declare, compute_modes);

}  // namespace

}  // namespace orthodyn
