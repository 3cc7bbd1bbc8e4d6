#include "lib/study/jobs/job.h"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <new>

#include "lib/core/errors.h"
#include "lib/simulation/files.h"
#include "lib/simulation/fingerprints.h"
#include "lib/simulation/machine.h"
#include "lib/study/jobs/job_result.h"
#include "lib/study/jobs/json_values.h"

namespace orthodyn::study {

namespace fs = std::filesystem;

namespace {

std::string last_line(const fs::path& file) {
  std::ifstream in(file);
  std::string last;
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) last = line;
  return last;
}

Failure failure_of_process(const ProcessEnd& end, const fs::path& log) {
  if (end.kind == ProcessEnd::Kind::timed_out) return {kTimeLimit, "killed after the limit of the wall time"};
  if (end.kind == ProcessEnd::Kind::out_of_memory)
    return {reason_name(Reason::out_of_memory), "killed when it used more than the limit of memory"};
  const std::string last = last_line(log);
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
    return to_json(Failure{reason_name(Reason::out_of_memory), "the scene does not fit into the limit of memory"});
  }
}

}  // namespace

Json run_job(const std::string& program, const Job& job, const Stop& stop) {
  const fs::path result_file = job.folder / kResultFile, log = job.folder / "log.txt";
  write_file(job.folder / kSceneFile, {"# " + job.title + "\n" + job.scene});
  write_file(job.folder / kInputFile, {to_text(job.input, 2)});
  std::error_code ignored;
  fs::remove(result_file, ignored);
  const ProcessEnd end = run_process({program, job.command, job.folder.string()}, log, job.limits, stop);
  if (end.kind == ProcessEnd::Kind::interrupted) return nullptr;
  Json result = read_result(job.folder);
  if (!result.is_null()) return result;
  result = to_json(failure_of_process(end, log));
  write_result(job.folder, result);
  return result;
}

void serve_job(const fs::path& folder, const std::function<Json(const Json&)>& work) {
  std::ifstream in(folder / kInputFile);
  const Json input = Json::parse(in);
  if (input.at("code") != code_fingerprint())
    throw RunError("the program has changed since this was started; start it again");
  Json result = result_of([&] { return work(input); });
  result["at"] = utc_now();
  write_result(folder, result);
}

}  // namespace orthodyn::study
