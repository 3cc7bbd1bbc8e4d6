#include "lib/study/campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <fstream>

#include "lib/run/files.h"
#include "lib/study/fingerprint.h"
#include "lib/study/measure.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

// A process is killed when it has had the time of all its runs and this much more, s.
constexpr double kSetUpTime = 60;

std::string last_line(const fs::path& file) {
  std::ifstream in(file);
  std::string last;
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) last = line;
  return last;
}

Json read_json(const fs::path& file) {
  std::ifstream in(file);
  return Json::parse(in, nullptr, false);
}

Json died(const ProcessEnd& end, const fs::path& log) {
  const auto failed = [](const std::string& reason, const std::string& message) {
    return Json{{"status", "failed"}, {"reason", reason}, {"message", message}};
  };
  if (end.kind == ProcessEnd::Kind::timed_out) return failed("time limit", "killed after the limit of the wall time");
  const std::string said = last_line(log);
  const std::string how = end.kind == ProcessEnd::Kind::signalled
                              ? fmt::format("ended by signal {} ({})", end.code, strsignal(end.code))
                              : fmt::format("ended with code {}", end.code);
  return failed("crashed", how + (said.empty() ? "" : ": " + said));
}

double smallest(const std::vector<double>& values, double otherwise) {
  return values.empty() ? otherwise : *std::min_element(values.begin(), values.end());
}

// A section {type: ..., key: value} as a method's name, options and words.
struct Section {
  std::string type, words;
  Assignments options;
};

Section read_section(const std::string& yaml) {
  const Config config = Config::from_text(yaml, "reference");
  Section section;
  if (!config.is_map() || !config.has("type")) config.fail("expected a section with the key 'type', found " + yaml);
  section.type = section.words = config.at("type").text();
  for (const auto& key : config.keys()) {
    if (key == "type") continue;
    section.options.emplace_back(key, config.at(key).yaml());
    section.words += ", " + key + " " + config.at(key).yaml();
  }
  return section;
}

// The mesh file's place is that of the scene: from the task's folder it is reached by its full path.
std::string placed_scene(const Config& scene) {
  const Config mesh = scene.at("mesh");
  if (mesh.has("file")) mesh.fill_text("file", fs::absolute(mesh.at("file").file_path()).string());
  return scene.dump();
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
                    {comparison_.repeats, comparison_.samples, comparison_.limits.seconds, measured_against, false, false}};
    Json result = perform(task, interrupt, point_folders_[i]);
    if (result.is_null()) return false;
    results_[i] = std::move(result);
    after_each();
  }
  return true;
}

Job Campaign::reference_job() const {
  Job job{0, comparison_.samples, comparison_.reference.seconds, "", true, false};
  job.exact_if_possible = comparison_.reference.kind == ReferenceKind::automatic;
  return job;
}

bool Campaign::find_reference(std::size_t problem, const std::atomic<bool>& interrupt) {
  const Problem& p = design_.problems[problem];
  const double tightest = smallest(comparison_.tolerances, 1e-6);
  const auto& options = comparison_.reference;
  const Section first = read_section(
      options.integrator ? options.integrator->text
                         : fmt::format("{{type: arkode_dirk, rtol: {}}}", std::max(1e-3 * tightest, 1e-11)));
  const Section second = read_section(
      options.check ? options.check->text
                    : fmt::format("{{type: cvode_bdf, max_order: 5, rtol: {}}}", std::max(1e-3 * tightest, 1e-10)));
  ReferenceResult reference;
  Task task{p.label + ", reference", "references", scene_config(p, first.type, first.options), reference_job()};
  reference.method = first.words;
  std::string folder;
  reference.result = perform(task, interrupt, folder);
  if (reference.result.is_null()) return false;
  const bool usable = reference.result.at("status") == "completed";
  if (usable) reference.folder = folder;
  if (usable && reference.result.at("kind") == "computed") {
    reference.check_method = second.words;
    task.title = p.label + ", check of the reference";
    task.scene = scene_config(p, second.type, second.options);
    task.job = {0, comparison_.samples, options.seconds, fs::absolute(options_.folder / folder).string(), false, false};
    reference.check = perform(task, interrupt, folder);
    if (reference.check.is_null()) return false;
  } else {
    --count_;
  }
  references_[problem] = std::move(reference);
  return true;
}

std::string Campaign::prepare(const Task& task) {
  Fingerprint print;
  Json job = task.job.json();
  job["reference"] = fs::path(task.job.reference).filename().string();  // a fingerprint itself
  print.add(code_).add(task.scene.dump()).add(job.dump()).add(fmt::format("{}", comparison_.limits.memory));
  if (task.scene.at("mesh").has("file")) print.add_file(task.scene.at("mesh").at("file").file_path());
  const std::string folder = task.kind + "/" + print.text();
  if (!fs::exists(options_.folder / folder / kResultFile)) {
    write_file(options_.folder / folder / kSceneFile, {"# " + task.title + "\n" + placed_scene(task.scene)});
    write_file(options_.folder / folder / kJobFile, {task.job.json().dump(2) + "\n"});
  }
  return folder;
}

Json Campaign::perform(const Task& task, const std::atomic<bool>& interrupt, std::string& folder) {
  folder = prepare(task);
  ++number_;
  const fs::path path = options_.folder / folder;
  Json result = read_json(path / kResultFile);
  const bool cached = result.is_object();
  if (!cached) {
    options_.notify({number_, count_, task.title, true, false, nullptr});
    result = execute(path, task.job, interrupt);
    if (result.is_null()) return result;
  }
  options_.notify({number_, count_, task.title, false, cached, &result});
  return result;
}

Json Campaign::execute(const fs::path& folder, const Job& job, const std::atomic<bool>& interrupt) {
  const ProcessLimits limits{job.seconds * (job.repeats + 3) + kSetUpTime, comparison_.limits.memory};
  const fs::path log = folder / "log.txt";
  const ProcessEnd end = run_process({options_.program, "measure", folder.string()}, log, limits, interrupt);
  if (end.kind == ProcessEnd::Kind::interrupted) return nullptr;
  Json result = read_json(folder / kResultFile);
  if (result.is_object()) return result;
  result = died(end, log);
  write_file(folder / kResultFile, {result.dump() + "\n"});
  return result;
}

}  // namespace orthodyn
