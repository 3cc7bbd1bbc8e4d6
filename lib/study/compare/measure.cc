#include "lib/study/compare/measure.h"

#include <fstream>

#include "lib/simulation/files.h"
#include "lib/simulation/fingerprints.h"
#include "lib/simulation/machine.h"
#include "lib/study/compare/measurement.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

Json failure(const std::string& reason, const std::string& message) {
  return {{"status", "failed"}, {"reason", reason}, {"message", message}};
}

Json attempted(const std::function<Json()>& work) {
  try {
    return work();
  } catch (const ConfigError& e) {
    return failure("refused", e.what());
  } catch (const RunError& e) {
    return failure(reason_name(e.reason()), e.what());
  } catch (const std::bad_alloc&) {
    return failure(reason_name(Reason::out_of_memory), "the scene does not fit into the limit of memory");
  }
}

}  // namespace

void do_job(const fs::path& folder, const std::function<Json(const Json&)>& work) {
  std::ifstream in(folder / kJobFile);
  const Json job = Json::parse(in);
  if (job.at("code") != code_fingerprint())
    throw RunError("the program has changed since this was started; start it again");
  Json result = attempted([&] { return work(job); });
  result["at"] = utc_now();
  write_file(folder / kResultFile, {to_text(result)});
}

void measure(const fs::path& folder) {
  do_job(folder, [&](const Json& job) {
    return Measurement(set_up(Config::from_file((folder / kSceneFile).string())), Job::from(job), folder).result();
  });
}

}  // namespace orthodyn
