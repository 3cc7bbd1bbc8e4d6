// `orthodyn run`: one scene from start to end, with everything that it writes.
#include <fmt/format.h>

#include <filesystem>

#include "lib/core/versions.h"
#include "lib/run/progress.h"
#include "lib/run/vtu.h"
#include "tools/orthodyn/interrupt.h"
#include "tools/orthodyn/report.h"
#include "tools/orthodyn/result_folder.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

Plan plan_of(const Scene& scene) {
  const auto& out = scene.output;
  const double start = scene.time.start, end = scene.time.end;
  Plan plan{end, {}, out.times == OutputTimes::exact};
  plan.output_times = out.interval ? by_interval(start, end, *out.interval)
                                   : evenly_spaced(start, end, out.frames.value_or(50));
  return plan;
}

std::vector<ProbeColumn> probe_columns(const Scene& scene, const TetMesh& mesh) {
  std::vector<ProbeColumn> columns;
  for (const auto& [name, probe] : scene.output.probes)
    for (const auto& field : probe.fields) columns.push_back({name, nearest_node(mesh, probe.at), field});
  return columns;
}

// The scene with every default, so placed that it can be run from the result's folder.
std::string resolved_scene(const Setup& setup, const RunArguments& arguments, const fs::path& folder) {
  const Config mesh = setup.config.at("mesh");
  if (mesh.has("file"))
    mesh.fill_text("file", fs::proximate(mesh.at("file").file_path(), folder).string());
  return fmt::format("# {} with every default spelled out, by orthodyn {}.\n{}", arguments.scene,
                     orthodyn_version(), setup.config.dump());
}

// Everything that looks on, as the scene asks.
class Observers {
 public:
  Observers(const Setup& setup, const RunArguments& arguments, const fs::path& folder)
      : inversion(*setup.built.model) {
    const auto& model = *setup.built.model;
    const auto& scene = setup.scene;
    if (!scene.output.fields.empty()) frames_.emplace(folder, model, scene.output.fields);
    if (scene.output.energy)
      energy.emplace(folder / "energy.csv", model, *setup.integrator);
    if (scene.output.momentum) momentum.emplace(folder / "momentum.csv", model);
    if (scene.output.steps) steps_.emplace(folder / "steps.csv");
    if (!scene.output.probes.empty())
      probes_.emplace(folder / "probes.csv", model, probe_columns(scene, model.parts().mesh));
    if (!arguments.quiet) progress_.emplace(scene.time.start, scene.time.end, stderr);
  }

  std::vector<Observer*> all() {
    std::vector<Observer*> out{&inversion};
    const auto add = [&](auto& observer) { if (observer) out.push_back(&*observer); };
    add(frames_);
    add(energy);
    add(momentum);
    add(steps_);
    add(probes_);
    add(progress_);
    return out;
  }

  InversionWatch inversion;
  std::optional<EnergyWriter> energy;
  std::optional<MomentumWriter> momentum;

 private:
  std::optional<VtuWriter> frames_;
  std::optional<StepWriter> steps_;
  std::optional<ProbeWriter> probes_;
  std::optional<Progress> progress_;
};

int exit_code(Outcome::Status status) {
  return status == Outcome::Status::completed ? 0 : status == Outcome::Status::interrupted ? 130 : 3;
}

}  // namespace

int run_command(const RunArguments& arguments) {
  const ResultFolder folder(arguments.out ? fs::path(*arguments.out)
                                          : fs::path("out") / fs::path(arguments.scene).stem(),
                            arguments.force);
  Setup setup = set_up(arguments);
  const std::string resolved = resolved_scene(setup, arguments, folder.path());
  folder.prepare();
  const ReservedFile record(folder.path() / "run.json", run_json(arguments, nullptr));
  write_file(folder.path() / "scene.yaml", {resolved});

  Observers observers(setup, arguments, folder.path());
  heed_interrupts();
  const Outcome outcome = run(*setup.built.model, *setup.integrator, setup.built.initial, plan_of(setup.scene),
                              observers.all(), interrupted());
  const RunReport report{arguments, setup, outcome, observers.inversion,
                         observers.energy ? &*observers.energy : nullptr,
                         observers.momentum ? &*observers.momentum : nullptr};
  if (outcome.status == Outcome::Status::failed) fmt::print(stderr, "error: {}\n", outcome.message);
  record.rewrite(run_json(arguments, &report));
  if (!arguments.quiet) print_summary(report, folder.path());
  if (observers.inversion.smallest() <= 0)
    fmt::print(stderr, "warning: element {} was inverted at t = {:.4g} s (det F = {:.3g})\n",
               observers.inversion.element(), observers.inversion.time(), observers.inversion.smallest());
  if (outcome.status == Outcome::Status::interrupted)
    fmt::print(stderr, "interrupted at t = {:.6g} s; what was computed is in {}\n", outcome.last.t,
               folder.path().string());
  return exit_code(outcome.status);
}

}  // namespace orthodyn
