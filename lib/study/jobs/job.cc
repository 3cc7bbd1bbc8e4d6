#include "lib/study/jobs/job.h"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <new>
#include <stdexcept>

#include "lib/core/errors.h"
#include "lib/scene/mesh_materials.h"
#include "lib/scene/scene.h"
#include "lib/simulation/output/files.h"
#include "lib/simulation/run/fingerprints.h"
#include "lib/simulation/run/machine.h"
#include "lib/simulation/run/several_ranks.h"
#include "lib/study/jobs/job_result.h"
#include "lib/study/jobs/json_values.h"

namespace orthodyn::study {

namespace fs = std::filesystem;

namespace {

// The last error in a log, otherwise the first line of an mpirun message (between lines of dashes), otherwise the last
// line.
std::string last_error(const fs::path& file) {
  std::ifstream in(file);
  std::string last, error, of_mpirun;
  bool is_after_dashes = false;
  for (std::string line; std::getline(in, line);) {
    const bool is_dashes = line.starts_with("-----");
    if (is_after_dashes && of_mpirun.empty() && !is_dashes) of_mpirun = line;
    if (line.starts_with("error: ")) error = line;
    if (!line.empty() && !is_dashes) last = line;
    is_after_dashes = is_dashes;
  }
  return !error.empty() ? error : !of_mpirun.empty() ? of_mpirun : last;
}

Failure failure_of_process(const ProcessEnd& end, const fs::path& log) {
  if (end.kind == ProcessEnd::Kind::timed_out) return {kTimeLimit, "killed at the wall time limit"};
  if (end.kind == ProcessEnd::Kind::out_of_memory)
    return {reason_name(Reason::out_of_memory), "killed above the memory limit"};
  const std::string last = last_error(log);
  const std::string how = end.kind == ProcessEnd::Kind::signalled
                              ? fmt::format("ended by signal {} ({})", end.code, strsignal(end.code))
                              : fmt::format("ended with code {}", end.code);
  return {kCrashed, how + (last.empty() ? "" : ": " + last)};
}

Json result_of(const std::function<Json()>& work) {
  try {
    return work();
  } catch (const ConfigError& e) {
    return to_json(Failure{kRefused, e.what()});
  } catch (const RunError& e) {
    return to_json(Failure{reason_name(e.reason()), e.what()});
  } catch (const std::bad_alloc&) {
    return to_json(Failure{reason_name(Reason::out_of_memory), "the scene needs more memory than its limit"});
  }
}

}  // namespace

std::string mesh_hash(const Config& scene) {
  try {
    return mesh_fingerprint(load_mesh(read_scene(scene)));
  } catch (const ConfigError& e) {
    return e.what();
  }
}

Json run_job(const std::vector<std::string>& program, const Job& job, const Stop& stop) {
  const fs::path result_file = job.folder / kResultFile, log = job.folder / "log.txt";
  write_file(job.folder / kSceneFile, {"# " + job.title + "\n" + job.scene});
  write_file(job.folder / kInputFile, {to_text(job.input, 2)});
  std::error_code ignored;
  fs::remove(result_file, ignored);
  std::vector<std::string> command = program;
  command.insert(command.end(), {job.command, job.folder.string()});
  const ProcessEnd end = run_process(command, log, job.limits, stop);
  if (end.kind == ProcessEnd::Kind::interrupted) return nullptr;
  Json result = read_result(job.folder);
  if (!result.is_null()) return result;
  result = to_json(failure_of_process(end, log));
  write_result(job.folder, result);
  return result;
}

void serve_job(const fs::path& folder, const std::function<Json(const Json&)>& work, const Ranks* ranks) {
  std::ifstream in(folder / kInputFile);
  const Json input = Json::parse(in);
  if (input.at("code") != code_fingerprint())
    throw RunError("the program has changed since this study was started; start the study again");
  Json result = result_of([&] { return work(input); });
  const auto failure = failure_from(result);
  if (failure && only_this_rank_failed(ranks)) throw std::runtime_error(failure->message);
  result["at"] = utc_now();
  write_result(folder, result);
}

}  // namespace orthodyn::study
