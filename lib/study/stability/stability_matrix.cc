#include "lib/study/stability/stability_matrix.h"

#include <fmt/format.h>

#include <utility>

#include "lib/scene/build.h"
#include "lib/scene/mesh_materials.h"
#include "lib/study/jobs/csv_cell.h"
#include "lib/study/jobs/deadline.h"
#include "lib/study/compare/expand.h"
#include "lib/simulation/fingerprints.h"
#include "lib/simulation/machine.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

// Builds the scene, too: what is wrong with it shows before anything runs.
std::string mesh_of(const Trial& trial) {
  try {
    const Scene scene = read_scene(trial.scene.copy());
    build(scene);
    return mesh_fingerprint(load_mesh(scene));
  } catch (const ConfigError& e) {
    throw ConfigError(e.place(), fmt::format("{} (in {})", e.message(), trial.title));
  }
}

// What a process could not grade itself: its integrator refused the scene, it was killed, or it died.
void grade(Json& result) {
  if (result.contains("grade")) return;
  const std::string reason = result.at("reason");
  result["grade"] = reason == "refused" ? "refused" : "fail";
  if (reason != kTimeLimit) result["reason"] = result.at("message");
}

Json member(const Json& object, const char* key) { return object.contains(key) ? object.at(key) : Json(nullptr); }

}  // namespace

StabilityMatrix::StabilityMatrix(Stability stability, fs::path folder, std::string program)
    : stability_(std::move(stability)), folder_(std::move(folder)), program_(std::move(program)),
      trials_(orthodyn::trials(stability_)) {
  for (const auto& hard : stability_.cases) sentences_.push_back(head_comment(read_yaml(hard.file)));
  const std::string code = code_fingerprint();
  std::map<std::pair<std::size_t, std::size_t>, std::string> meshes;  // of a case with a variant
  FileFingerprints files;
  const Json job{{"seconds", stability_.limits.seconds}, {"code", code}};
  const ProcessLimits limits{stability_.limits.seconds + kSetUpTime, stability_.limits.memory};
  for (const Trial& trial : trials_) {
    std::string& mesh = meshes[{trial.hard_case, trial.variant}];
    if (mesh.empty()) mesh = mesh_of(trial);
    Fingerprint print;
    print.add(machine_fingerprint()).add(trial.scene.dump()).add(job.dump());
    print.add(fmt::format("{}", limits.memory)).add(mesh);
    for (const auto& file : trial.scene.file_paths()) print.add(files.of(file));
    errands_.push_back({trial.title, "assess", folder_ / "trials" / print.text(), trial.scene.dump_for(""), job, limits});
  }
}

bool StabilityMatrix::run(int jobs, const std::atomic<bool>& interrupt, const ErrandEvents& events, OldFailures failures) {
  return carry_out_all(program_, errands_, jobs, interrupt,
                       {events.starts, [&](std::size_t i, Json result, bool cached) {
                          grade(result);
                          results_[i] = std::move(result);
                          events.ends(i, results_[i], cached);
                        }},
                       failures);
}

Json StabilityMatrix::trial_json(std::size_t trial) const {
  const Trial& t = trials_[trial];
  Json json{{"case", stability_.cases[t.hard_case].label},
            {"variant", stability_.variants[t.variant].first},
            {"integrator", stability_.integrators[t.integrator].label},
            {"folder", fs::relative(errands_[trial].folder, folder_).string()}};
  json.update(results_.at(trial));
  return json;
}

Json StabilityMatrix::json(const std::string& file) const {
  Json json{{"kind", "stability"},       {"title", stability_.title}, {"description", stability_.description},
            {"file", file},              {"at", utc_now()},           {"machine", machine_json()},
            {"versions", versions_json()}, {"limit", stability_.limits.seconds}};
  for (std::size_t c = 0; c < stability_.cases.size(); ++c) {
    const HardCase& hard = stability_.cases[c];
    json["cases"].push_back(
        {{"label", hard.label}, {"file", hard.file.path}, {"sentence", sentences_[c]}, {"model", hard.model}});
  }
  for (const auto& [name, changes] : stability_.variants) json["variants"].push_back(name);
  for (const auto& integrator : stability_.integrators) json["integrators"].push_back(integrator.label);
  json["complete"] = results_.size() == trials_.size();
  json["trials"] = Json::array();
  for (const auto& [trial, result] : results_) json["trials"].push_back(trial_json(trial));
  return json;
}

std::string StabilityMatrix::csv() const {
  std::string csv =
      "case,variant,integrator,grade,reason,figure,unit,computed,expected,limit,time_reached [s],wall [s],cpu [s],steps\n";
  for (const auto& [trial, result] : results_) {
    const Json t = trial_json(trial), worst = member(t, "worst"), statistics = member(t, "statistics");
    const std::vector<Json> row{t.at("case"), t.at("variant"), t.at("integrator"), t.at("grade"), t.at("reason"),
                                member(worst, "title"), member(worst, "unit"), member(worst, "computed"), member(worst, "expected"),
                                member(worst, "limit"), member(t, "time_reached"), member(t, "wall"), member(t, "cpu"),
                                member(statistics, "steps")};
    for (std::size_t k = 0; k < row.size(); ++k) csv += csv_cell(row[k]) + (k + 1 < row.size() ? "," : "\n");
  }
  return csv;
}

}  // namespace orthodyn
