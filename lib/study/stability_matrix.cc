#include "lib/study/stability_matrix.h"

#include <fmt/format.h>

#include "lib/scene/mesh_materials.h"
#include "lib/study/expand.h"
#include "lib/study/fingerprint.h"
#include "lib/study/machine.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

// A process is killed when it has had its time and this much more for the set-up, s.
constexpr double kSetUpTime = 30;

std::string mesh_of(const Config& scene) {
  try {
    return mesh_fingerprint(load_mesh(read_scene(Config::from_text(scene.dump(), scene.file()))));
  } catch (const ConfigError& e) {
    return e.what();  // every trial will say so itself
  }
}

std::string csv_text(std::string text) {
  for (char& c : text)
    if (c == '"' || c == '\n') c = '\'';
  return '"' + text + '"';
}

std::string csv_number(const Json& object, const char* key) {
  return object.contains(key) && object.at(key).is_number() ? fmt::format("{:.9g}", object.at(key).get<double>()) : "";
}

}  // namespace

StabilityMatrix::StabilityMatrix(Stability stability, fs::path folder, std::string program)
    : stability_(std::move(stability)), folder_(std::move(folder)), program_(std::move(program)),
      trials_(orthodyn::trials(stability_)) {
  const std::string code = code_fingerprint();
  std::map<std::pair<std::size_t, std::size_t>, std::string> meshes;  // of a case with a variant
  const Json job{{"seconds", stability_.limits.seconds}, {"code", code}};
  const ProcessLimits limits{stability_.limits.seconds + kSetUpTime, stability_.limits.memory};
  for (const Trial& trial : trials_) {
    std::string& mesh = meshes[{trial.hard_case, trial.variant}];
    if (mesh.empty()) mesh = mesh_of(trial.scene);
    Fingerprint print;
    print.add(machine_fingerprint()).add(trial.scene.dump()).add(job.dump());
    print.add(fmt::format("{}", limits.memory)).add(mesh);
    for (const auto& file : trial.scene.file_paths()) print.add_file(file);
    errands_.push_back({trial.title, "assess", folder_ / "trials" / print.text(), trial.scene.dump_for(""), job, limits});
  }
}

bool StabilityMatrix::run(int jobs, const std::atomic<bool>& interrupt, const ErrandEvents& events) {
  return carry_out_all(program_, errands_, jobs, interrupt,
                       {events.starts, [&](std::size_t i, const Json& result, bool cached) {
                          results_[i] = result;
                          // What the process could not say itself: it was killed, or died.
                          if (!results_[i].contains("grade")) results_[i]["grade"] = "fail";
                          events.ends(i, results_[i], cached);
                        }});
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
  for (const auto& hard : stability_.cases)
    json["cases"].push_back({{"label", hard.label},
                             {"file", hard.file.path},
                             {"sentence", head_comment(read_yaml(hard.file.path))},
                             {"model", hard.model}});
  for (const auto& [name, changes] : stability_.variants) json["variants"].push_back(name);
  for (const auto& integrator : stability_.integrators) json["integrators"].push_back(integrator.label);
  json["complete"] = results_.size() == trials_.size();
  json["trials"] = Json::array();
  for (const auto& [trial, result] : results_) json["trials"].push_back(trial_json(trial));
  return json;
}

std::string StabilityMatrix::csv() const {
  std::string csv = "case,variant,integrator,grade,reason,figure,computed,expected,limit,time_reached [s],wall [s],cpu [s],steps\n";
  for (const auto& [trial, result] : results_) {
    const Json t = trial_json(trial);
    const Json worst = t.contains("worst") && t.at("worst").is_object() ? t.at("worst") : Json::object();
    const Json statistics = t.contains("statistics") ? t.at("statistics") : Json::object();
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_text(t.at("case")), csv_text(t.at("variant")),
                       csv_text(t.at("integrator")), t.at("grade").get<std::string>(), csv_text(t.at("reason")),
                       worst.contains("title") ? csv_text(worst.at("title")) : "", csv_number(worst, "computed"),
                       csv_number(worst, "expected"), csv_number(worst, "limit"), csv_number(t, "time_reached"),
                       csv_number(t, "wall"), csv_number(t, "cpu"), csv_number(statistics, "steps"));
  }
  return csv;
}

}  // namespace orthodyn
