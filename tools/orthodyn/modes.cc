// `orthodyn modes`: natural frequencies and shapes of a scene's body about rest or equilibrium, without damping.
#include <fmt/format.h>

#include <filesystem>

#include "lib/run/modes.h"
#include "lib/run/vtu.h"
#include "lib/scene/equilibrium.h"
#include "tools/orthodyn/commands.h"
#include "tools/orthodyn/draw.h"
#include "tools/orthodyn/setup.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

State state_about(const Setup& setup, bool equilibrium_asked) {
  const auto& scene = setup.scene;
  const Vector zero = Vector::Zero(setup.built.model->num_dofs());
  const double t = scene.analysis == Analysis::statical ? scene.time.end : scene.time.start;
  if (!equilibrium_asked) return {t, zero, zero};
  if (scene.start == Start::equilibrium) return {t, setup.built.initial.q, zero};
  if (!scene.statics) {
    Scene with = scene;
    with.statics = Statics::spec().read(Config::from_text("{}", "--equilibrium"));
    return {t, equilibrium(with, setup.built), zero};
  }
  return {t, equilibrium(scene, setup.built), zero};
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

void print_table(const Setup& setup, const Modes& modes, bool equilibrium) {
  const double mass = setup.built.model->parts().mass->total();
  fmt::print("natural modes about {}, {} mass, without damping: {} of {}\n", equilibrium ? "equilibrium" : "rest",
             setup.built.model->parts().mass->lumped() ? "lumped" : "consistent", modes.modes.size(),
             setup.built.model->num_dofs());
  if (modes.rigid > 0)
    fmt::print("the first {} {} rigid: 0 Hz, nothing holds them\n", modes.rigid, modes.rigid == 1 ? "is" : "are");
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

}  // namespace

int modes_command(const ModesArguments& arguments) {
  const Setup setup = set_up_and_warn(read_config(arguments.scene, std::nullopt, arguments.set));
  const State about = state_about(setup, arguments.equilibrium);
  const Modes modes = natural_modes(*setup.built.model, about, arguments.count);
  const fs::path folder = arguments.out ? fs::path(*arguments.out) : fs::path("out") / "modes" / fs::path(arguments.scene).stem();
  write_csv(folder / "modes.csv", modes);
  write_shapes(folder, *setup.built.model, about, modes);
  if (arguments.quiet) return 0;
  print_table(setup, modes, arguments.equilibrium);
  fmt::print("results {}\n", folder.string());
  draw_modes(folder);
  return 0;
}

}  // namespace orthodyn
