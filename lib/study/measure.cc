#include "lib/study/measure.h"

#include <fstream>

#include "lib/run/files.h"
#include "lib/study/fingerprint.h"
#include "lib/study/machine.h"
#include "lib/study/measurement.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

Json failure(const std::string& reason, const std::string& message) {
  return {{"status", "failed"}, {"reason", reason}, {"message", message}};
}

Json measured(const fs::path& folder) {
  std::ifstream in(folder / kJobFile);
  const Job job = Job::from(Json::parse(in));
  if (job.code != code_fingerprint())
    throw RunError("the program has changed since the comparison was started; start it again");
  try {
    return Measurement(set_up(Config::from_file((folder / kSceneFile).string())), job, folder).result();
  } catch (const ConfigError& e) {
    return failure("refused", e.what());
  } catch (const std::bad_alloc&) {
    return failure(reason_name(Reason::out_of_memory), "the scene does not fit into the limit of memory");
  }
}

}  // namespace

void measure(const fs::path& folder) {
  Json result = measured(folder);
  result["at"] = utc_now();
  write_file(folder / kResultFile, {to_text(result)});
}

}  // namespace orthodyn
