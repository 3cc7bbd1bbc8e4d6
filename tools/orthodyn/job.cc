// `orthodyn measure`, `evaluate` and `assess`: one job of a study, in a process of its own.
#include "lib/simulation/run/fingerprints.h"
#include "lib/study/compare/measurement.h"
#include "lib/study/points/evaluate_point.h"
#include "lib/study/stability/evaluate_case.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/on_ranks.h"

namespace orthodyn {

namespace {

struct JobArguments {
  std::string folder;
};

void declare(JobArguments& arguments, CommandOptions& options) { options.value("folder", arguments.folder).required(); }

template <void (*work)(const std::filesystem::path&)>
int do_in_folder(const JobArguments& arguments) {
  work(arguments.folder);
  return 0;
}

// By this process and others, where mpirun has started several.
template <void (*work)(const std::filesystem::path&, const Ranks*)>
int do_on_ranks(const JobArguments& arguments) {
  code_fingerprint();  // before MPI's libraries are among the program's
  return on_world_ranks([&](const Ranks* ranks) {
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
                                          declare, do_on_ranks<study::compare::measure>);
const CommandRegistration evaluate_command(text_on_ranks(51, "evaluate", "One point of a sweep; called by sweep."),
                                           declare, do_on_ranks<study::evaluate_point>);
const CommandRegistration assess_command(text(61, "assess", "One case of a matrix; called by stability."), declare,
                                         do_in_folder<study::stability::evaluate_case>);

}  // namespace

}  // namespace orthodyn
