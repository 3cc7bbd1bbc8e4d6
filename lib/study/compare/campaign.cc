#include "lib/study/compare/campaign.h"

#include <fmt/format.h>

#include "lib/scene/mesh_materials.h"
#include "lib/study/compare/measure.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

bool is_finished(const fs::path& folder, const Json& result, const Job& job) {
  if (!result.is_object()) return false;
  return !job.keep_trajectory || result.at("status") != "completed" || Trajectory::is_whole(folder / kTrajectoryFile);
}

}  // namespace

Campaign::Campaign(const Comparison& comparison, Design design, CampaignOptions options)
    : comparison_(comparison), design_(std::move(design)), options_(std::move(options)), code_(code_fingerprint()),
      count_(design_.points.size()) {
  if (comparison_.reference.kind != ReferenceKind::none) count_ += 2 * design_.problems.size();
}

bool Campaign::run(const std::atomic<bool>& interrupt, const std::function<void()>& after_each) {
  for (std::size_t p = 0; p < design_.problems.size(); ++p) {
    if (comparison_.reference.kind != ReferenceKind::none && !find_reference(p, interrupt)) return false;
    after_each();
    if (!measure_points(p, interrupt, after_each)) return false;
  }
  return true;
}

bool Campaign::measure_points(std::size_t problem, const std::atomic<bool>& interrupt,
                              const std::function<void()>& after_each) {
  for (std::size_t i = 0; i < design_.points.size(); ++i) {
    const Point& point = design_.points[i];
    if (point.problem != problem) continue;
    const auto reference = references_.find(problem);
    const std::string measured_against =
        reference == references_.end() || reference->second.folder.empty()
            ? ""
            : fs::absolute(options_.folder / reference->second.folder).string();
    const Task task{title(design_, point), "points", point_scene(design_, point),
                    {comparison_.repeats, comparison_.samples, comparison_.limits.seconds, measured_against, false,
                     false, code_}, problem};
    Json result = perform(task, interrupt, point_folders_[i]);
    if (result.is_null()) return false;
    results_[i] = std::move(result);
    after_each();
  }
  return true;
}

Job Campaign::reference_job() const {
  Job job{0, comparison_.samples, comparison_.reference.seconds, "", true, false, code_};
  job.exact_if_possible = comparison_.reference.kind == ReferenceKind::automatic;
  return job;
}

bool Campaign::find_reference(std::size_t problem, const std::atomic<bool>& interrupt) {
  const Problem& p = design_.problems[problem];
  ReferenceResult reference{"", design_.reference.label, design_.check.label, nullptr, nullptr};
  Task task{p.label + ", reference", "references", reference_scene(p, design_.reference), reference_job(), problem};
  std::string folder;
  reference.result = perform(task, interrupt, folder);
  if (reference.result.is_null()) return false;
  const bool usable = reference.result.at("status") == "completed";
  if (usable) reference.folder = folder;
  if (usable && reference.result.at("kind") == "computed") {
    task.title = p.label + ", check of the reference";
    task.scene = reference_scene(p, design_.check);
    task.job = reference_job();
    task.job.keep_trajectory = task.job.exact_if_possible = false;
    task.job.reference = fs::absolute(options_.folder / folder).string();
    reference.check = perform(task, interrupt, folder);
    if (reference.check.is_null()) return false;
  } else {
    --count_;
  }
  references_[problem] = std::move(reference);
  return true;
}

// With what the named files bring along: elements beside .node, files that a .veg includes. Not loaded
// twice for a problem, whose points differ in their integrators only.
const std::string& Campaign::mesh_of(const Task& task) {
  std::string& print = meshes_[task.problem];
  if (!print.empty()) return print;
  try {
    print = mesh_fingerprint(load_mesh(read_scene(task.scene.copy())));
  } catch (const ConfigError& e) {
    print = e.what();  // every run of this problem will say so itself
  }
  return print;
}

std::string Campaign::folder_of(const Task& task) {
  Fingerprint print;
  Json job = task.job.json();
  job["reference"] = fs::path(task.job.reference).filename().string();  // a fingerprint itself
  print.add(machine_fingerprint()).add(task.scene.dump()).add(job.dump());
  print.add(fmt::format("{}", comparison_.limits.memory));
  for (const auto& file : task.scene.file_paths()) print.add(files_.of(file));
  print.add(mesh_of(task));
  return task.kind + "/" + print.text();
}

Json Campaign::perform(const Task& task, const std::atomic<bool>& interrupt, std::string& folder) {
  folder = folder_of(task);
  ++number_;
  const fs::path path = options_.folder / folder;
  Json result = finished(path, options_.failures);
  const bool cached = is_finished(path, result, task.job);
  if (!cached) {
    options_.notify({number_, count_, task.title, true, false, nullptr});
    result = execute(path, task, interrupt);
    if (result.is_null()) return result;
  }
  options_.notify({number_, count_, task.title, false, cached, &result});
  return result;
}

Json Campaign::execute(const fs::path& folder, const Task& task, const std::atomic<bool>& interrupt) const {
  const Job& job = task.job;
  const ProcessLimits limits{job.seconds * (job.repeats + 3) + kSetUpTime, comparison_.limits.memory};
  return carry_out(options_.program, {task.title, "measure", folder, task.scene.dump_for(""), job.json(), limits},
                   [&] { return interrupt.load(); });
}

}  // namespace orthodyn
