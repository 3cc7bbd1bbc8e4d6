#include "lib/study/compare/comparison_run.h"

#include <fmt/format.h>

#include "lib/study/compare/measurement.h"

namespace orthodyn::study::compare {

namespace fs = std::filesystem;

ComparisonRun::ComparisonRun(const Comparison& comparison, Design design, fs::path folder, int ranks,
                             std::function<void(const Progress&)> report)
    : comparison_(comparison),
      design_(std::move(design)),
      folder_(std::move(folder)),
      ranks_(ranks),
      report_(std::move(report)),
      code_(code_fingerprint()),
      count_(design_.points.size()) {
  if (comparison_.reference.kind != ReferenceKind::none) count_ += 2 * design_.groups.size();
}

bool ComparisonRun::run(const JobQueue& queue, const std::function<void()>& after_each) {
  for (std::size_t g = 0; g < design_.groups.size(); ++g) {
    if (comparison_.reference.kind != ReferenceKind::none && !find_reference(queue, g)) return false;
    after_each();
    for (std::size_t p = 0; p < design_.problems.size(); ++p)
      if (design_.problems[p].group == g && !measure_points(queue, p, after_each)) return false;
  }
  return true;
}

bool ComparisonRun::find_reference(const JobQueue& queue, std::size_t group) {
  const Group& g = design_.groups[group];
  const std::string mesh = design_.across_meshes ? "reference of " + g.id : g.id;
  MeasurementInput input = reference_input();
  const Config scene = reference_scene(g, design_.reference, design_.frames);
  const Job job = job_for(g.label + ", reference", "references", scene, mesh, input);
  const auto result = measure_one(queue, job);
  if (!result) return false;
  Reference reference{"", design_.reference.label, design_.check.label, *result, std::nullopt};
  if (!result->failure) reference.folder = relative_folder(job);
  if (!result->failure && result->kind == MeasurementResult::Kind::computed) {
    input.keep_trajectory = input.exact_if_possible = false;
    input.reference = fs::absolute(job.folder).string();
    reference.check = measure_one(queue, job_for(g.label + ", check of the reference", "references",
                                                 reference_scene(g, design_.check), mesh, input));
    if (!reference.check) return false;
  } else {
    --count_;  // no check needed
  }
  references_[group] = std::move(reference);
  return true;
}

bool ComparisonRun::measure_points(const JobQueue& queue, std::size_t problem,
                                   const std::function<void()>& after_each) {
  const MeasurementInput input = point_input(design_.problems[problem].group);
  std::vector<std::size_t> points;
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < design_.points.size(); ++i) {
    const Point& point = design_.points[i];
    if (point.problem != problem) continue;
    points.push_back(i);
    jobs.push_back(
        job_for(title(design_, point), "points", point_scene(design_, point), design_.problems[problem].id, input));
    point_folders_[i] = relative_folder(jobs.back());
  }
  JobEvents events;
  events.ends = [&](std::size_t k, const Json& result, bool cached) {
    results_[points[k]] = finish(jobs[k], result, cached);
    after_each();
  };
  return queue.run(jobs, events);
}

std::optional<MeasurementResult> ComparisonRun::measure_one(const JobQueue& queue, const Job& job) {
  std::optional<MeasurementResult> measured;
  JobEvents events;
  events.ends = [&](std::size_t, const Json& result, bool cached) { measured = finish(job, result, cached); };
  queue.run({job}, events);
  return measured;
}

MeasurementResult ComparisonRun::finish(const Job& job, const Json& result, bool cached) {
  MeasurementResult measured = measurement_from(result);
  report_({count_, job.title, cached, measured});
  return measured;
}

Job ComparisonRun::job_for(const std::string& title, const std::string& kind, const Config& scene,
                           const std::string& mesh, const MeasurementInput& input) {
  const fs::path folder = folder_ / kind / fingerprint(scene, mesh, input);
  const ProcessLimits limits{input.seconds * (input.repeats + 3) + kSetUpSeconds, comparison_.limits.memory};
  Job job{title, "measure", folder, scene.dump_for(""), to_json(input), limits};
  if (input.keep_trajectory)
    job.is_whole = [folder](const Json& result) {
      return failure_from(result).has_value() || Trajectory::is_whole(folder / kTrajectoryFile);
    };
  return job;
}

// Fingerprint of everything that a measurement depends on.
std::string ComparisonRun::fingerprint(const Config& scene, const std::string& mesh, const MeasurementInput& input) {
  Json job = to_json(input);
  job["reference"] = fs::path(input.reference).filename().string();  // the folder's name is a fingerprint
  Fingerprint hash;
  hash.add(machine_fingerprint()).add(scene.dump()).add(job.dump());
  hash.add(fmt::format("{}", comparison_.limits.memory));
  if (ranks_ > 1) hash.add(fmt::format("{} ranks", ranks_));
  for (const auto& file : scene.file_paths()) hash.add(files_.of(file));
  return hash.add(mesh_of(scene, mesh)).text();
}

// The mesh is loaded once per problem, because a problem's points differ only in their integrators.
const std::string& ComparisonRun::mesh_of(const Config& scene, const std::string& mesh) {
  std::string& hash = meshes_[mesh];
  if (hash.empty()) hash = mesh_hash(scene);
  return hash;
}

MeasurementInput ComparisonRun::point_input(std::size_t group) const {
  const auto found = references_.find(group);
  const bool is_usable = found != references_.end() && !found->second.folder.empty();
  return {.repeats = comparison_.repeats,
          .samples = comparison_.samples,
          .seconds = comparison_.limits.seconds,
          .reference = is_usable ? fs::absolute(folder_ / found->second.folder).string() : "",
          .at_probes = design_.across_meshes,
          .quantities = comparison_.quantities,
          .code = code_};
}

MeasurementInput ComparisonRun::reference_input() const {
  const bool exact = comparison_.reference.kind == ReferenceKind::automatic;
  return {.repeats = 0,
          .samples = comparison_.samples,
          .seconds = comparison_.reference.seconds,
          .reference = "",
          .keep_trajectory = true,
          .exact_if_possible = exact,
          .at_probes = design_.across_meshes,
          .quantities = comparison_.quantities,
          .code = code_};
}

std::string ComparisonRun::relative_folder(const Job& job) const {
  return (job.folder.parent_path().filename() / job.folder.filename()).string();
}

}  // namespace orthodyn::study::compare
