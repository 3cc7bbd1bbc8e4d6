#include "lib/study/stability/stability_matrix.h"

#include <fmt/format.h>

#include <utility>

#include "lib/scene/build.h"
#include "lib/scene/mesh_materials.h"
#include "lib/simulation/run/fingerprints.h"
#include "lib/simulation/run/machine.h"
#include "lib/study/inputs/scene_entry.h"
#include "lib/study/jobs/json_fields.h"

namespace orthodyn::study::stability {

namespace fs = std::filesystem;

namespace {

// Also builds the scene, so that its errors are reported before anything runs.
std::string hash_of_built_mesh(const StabilityRun& run) {
  try {
    const Scene scene = read_scene(run.scene);
    build(scene);
    return mesh_fingerprint(load_mesh(scene));
  } catch (const ConfigError& e) {
    throw ConfigError(e.place(), fmt::format("{} (in {})", e.message(), run.title));
  }
}

std::vector<Job> jobs_of(const std::vector<StabilityRun>& runs, const Limits& limits, const fs::path& folder) {
  const Json input = to_json(CaseInput{limits.seconds, code_fingerprint()});
  const ProcessLimits process_limits{limits.seconds + kSetUpSeconds, limits.memory};
  std::map<std::pair<std::size_t, std::size_t>, std::string> meshes;  // by case and variant
  FileFingerprints files;
  std::vector<Job> jobs;
  for (const auto& run : runs) {
    std::string& mesh = meshes[{run.hard_case, run.variant}];
    if (mesh.empty()) mesh = hash_of_built_mesh(run);
    Fingerprint hash;
    hash.add(machine_fingerprint()).add(run.scene.dump()).add(input.dump());
    hash.add(fmt::format("{}", limits.memory)).add(mesh);
    for (const auto& file : run.scene.file_paths()) hash.add(files.of(file));
    jobs.push_back(
        {run.title, "assess", folder / "trials" / hash.text(), run.scene.dump_for(""), input, process_limits});
  }
  return jobs;
}

}  // namespace

StabilityMatrix::StabilityMatrix(Stability stability, fs::path folder)
    : stability_(std::move(stability)),
      folder_(std::move(folder)),
      runs_(stability_runs(stability_)),
      jobs_(jobs_of(runs_, stability_.limits, folder_)) {
  for (const auto& hard : stability_.cases) sentences_.push_back(head_comment(read_scene_text(hard.file)));
}

bool StabilityMatrix::run(const JobQueue& queue,
                          const std::function<void(std::size_t, const StabilityResult&, bool)>& after_each) {
  JobEvents events;
  events.ends = [&](std::size_t i, const Json& result, bool cached) {
    results_[i] = stability_result_from(result);
    after_each(i, results_[i], cached);
  };
  return queue.run(jobs_, events);
}

Json StabilityMatrix::run_json(std::size_t run, const StabilityResult& result) const {
  const StabilityRun& r = runs_[run];
  Json json{{"case", stability_.cases[r.hard_case].label},
            {"variant", stability_.variants[r.variant].first},
            {"integrator", stability_.integrators[r.integrator].label},
            {"folder", fs::relative(jobs_[run].folder, folder_).string()}};
  json.update(to_json(result));
  return json;
}

Json StabilityMatrix::json(const std::string& file) const {
  Json json{{"kind", "stability"},
            {"title", stability_.title},
            {"description", stability_.description},
            {"file", file},
            {"at", utc_now()},
            {"machine", machine_json()},
            {"versions", versions_json()},
            {"limit", stability_.limits.seconds}};
  for (std::size_t c = 0; c < stability_.cases.size(); ++c) {
    const HardCase& hard = stability_.cases[c];
    json["cases"].push_back(
        {{"label", hard.label}, {"file", hard.file.path}, {"sentence", sentences_[c]}, {"model", hard.model}});
  }
  for (const auto& [name, changes] : stability_.variants) json["variants"].push_back(name);
  for (const auto& integrator : stability_.integrators) json["integrators"].push_back(integrator.label);
  json["complete"] = results_.size() == runs_.size();
  json["trials"] = Json::array();
  for (const auto& [run, result] : results_) json["trials"].push_back(run_json(run, result));
  json["suspected"] = Json::array();
  for (const auto& s : suspected_expectations(json["cases"], json["trials"])) json["suspected"].push_back(describe(s));
  return json;
}

std::string StabilityMatrix::csv() const {
  static const std::vector<CsvColumn> columns{{"case", "", {"case"}},
                                              {"variant", "", {"variant"}},
                                              {"integrator", "", {"integrator"}},
                                              {"grade", "", {"grade"}},
                                              {"reason", "", {"reason"}},
                                              {"metric", "", {"worst", "title"}},
                                              {"unit", "", {"worst", "unit"}},
                                              {"computed", "", {"worst", "computed"}},
                                              {"expected", "", {"worst", "expected"}},
                                              {"limit", "", {"worst", "limit"}},
                                              {"time_reached", "s", {"time_reached"}},
                                              {"wall", "s", {"wall"}},
                                              {"cpu", "s", {"cpu"}},
                                              {"steps", "", {"statistics", "steps"}}};
  std::string csv = csv_head(columns) + "\n";
  for (const auto& [run, result] : results_) csv += csv_row(columns, run_json(run, result)) + "\n";
  return csv;
}

}  // namespace orthodyn::study::stability
