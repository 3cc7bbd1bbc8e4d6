// `orthodyn measure`, `evaluate` and `assess` (hidden): one job of a study in its own process.
#include "lib/simulation/run/fingerprints.h"
#include "lib/study/compare/measurement.h"
#include "lib/study/points/evaluation.h"
#include "lib/study/stability/stability_result.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/on_ranks.h"

namespace orthodyn {

namespace {

struct JobArguments {
  std::string folder;
};

void declare(JobArguments& arguments, CommandOptions& options) { options.value("folder", arguments.folder).required(); }

template <void (*work)(const std::filesystem::path&)>
int run_in_folder(const JobArguments& arguments) {
  work(arguments.folder);
  return 0;
}

template <void (*work)(const std::filesystem::path&, const Ranks*)>
int run_in_folder_on_ranks(const JobArguments& arguments) {
  code_fingerprint();  // stored before MPI libraries are loaded, which would change it
  return run_on_world_ranks([&](const Ranks* ranks) {
    work(arguments.folder, ranks);
    return 0;
  });
}

CommandText text(int order, const std::string& name, const std::string& sentence) {
  return {.order = order, .name = name, .sentence = sentence, .hidden = true};
}

CommandText text_on_ranks(int order, const std::string& name, const std::string& sentence) {
  CommandText out = text(order, name, sentence);
  out.on_ranks = true;
  return out;
}

const CommandRegistration measure_command(text_on_ranks(41, "measure", "One point of a comparison; called by compare."),
                                          declare, run_in_folder_on_ranks<study::compare::measure>);
const CommandRegistration evaluate_command(text_on_ranks(51, "evaluate", "One point of a sweep; called by sweep."),
                                           declare, run_in_folder_on_ranks<study::evaluate_point>);
const CommandRegistration assess_command(text(61, "assess", "One case of a matrix; called by stability."), declare,
                                         run_in_folder<study::stability::evaluate_case>);

}  // namespace

}  // namespace orthodyn
