// `orthodyn fit`: parameters of scenes from measured values.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "lib/core/spelling.h"
#include "lib/simulation/output/files.h"
#include "lib/study/fit/field_result.h"
#include "lib/study/fit/fit_run.h"
#include "lib/study/jobs/json_values.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/study_command.h"
#include "tools/orthodyn/study_messages.h"

namespace orthodyn::study::fit {

namespace fs = std::filesystem;

namespace {

std::string values_text(const Problem& problem, const Vector& values) {
  std::vector<std::string> words;
  for (const std::size_t p : problem.single_parameters()) {
    const FittedParameter& parameter = problem.parameters()[p];
    words.push_back(fmt::format("{} {:.5g}{}{}", parameter.name,
                                values[static_cast<Eigen::Index>(p)] / parameter.factor,
                                parameter.unit.empty() ? "" : " ", parameter.unit));
  }
  for (const ParameterField& field : problem.fields()) {
    const auto own = values.segment(static_cast<Eigen::Index>(field.first), static_cast<Eigen::Index>(field.size()));
    words.push_back(fmt::format("{} {:.3g} to {:.3g}", field.name, own.minCoeff(), own.maxCoeff()));
  }
  return join(words);
}

// Prints a line for each iteration and each stage, and between them every ten seconds how many runs are done.
class Printer {
 public:
  Printer(const Problem& problem, bool quiet) : problem_(problem), quiet_(quiet) {}

  void iteration(const Iteration& one) {
    if (quiet_) return;
    if (!one.accepted) {
      constexpr std::size_t kShown = 100;  // its beginning names the cause
      const std::string more = one.failure.size() > kShown ? "..." : "";
      return fmt::print("  {:3}  step rejected{}{}{}\n", one.number, one.failure.empty() ? "" : ": ",
                        one.failure.substr(0, kShown), more);
    }
    fmt::print("  {:3}  chi-square {:<10.5g}  {}\n", one.number, one.chi_square, values_text(problem_, one.values));
    std::fflush(stdout);
  }
  void stage(const std::string& name) {
    if (!quiet_) fmt::print("{}\n", name);
    std::fflush(stdout);
  }
  // A run ended. `count`: number of runs of this evaluation.
  void run(std::size_t count, bool cached) {
    ++done_;
    if (!cached) ++worked_;
    const auto now = Clock::now();
    const double left = seconds(began_, now) / static_cast<double>(std::max<std::size_t>(worked_, 1)) *
                        static_cast<double>(count - done_);
    if (!quiet_ && done_ < count && seconds(told_, now) > kInterval) {
      fmt::print("       run {} of {}, about {:.0f} s left\n", done_, count, left);
      std::fflush(stdout);
      told_ = now;
    }
    if (done_ >= count) done_ = worked_ = 0, began_ = told_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr double kInterval = 10;  // s
  static double seconds(Clock::time_point begin, Clock::time_point end) {
    return std::chrono::duration<double>(end - begin).count();
  }

  const Problem& problem_;
  bool quiet_;
  Clock::time_point began_ = Clock::now(), told_ = began_;  // of this evaluation; of the last line about runs
  std::size_t done_ = 0, worked_ = 0;                       // runs of this evaluation; those not found on disk
};

void write_results(const fs::path& folder, const Json& table) {
  write_file(folder / "fit.json", {to_text(table, 1)});
  write_file(folder / "parameters.csv", {parameters_csv(table)});
  write_file(folder / "data.csv", {data_csv(table)});
  for (const Json& field : table.at("fields"))
    write_file(folder / (field.at("name").get<std::string>() + ".csv"), {field_csv(field)});
  for (const Json& material : table.at("materials"))
    write_file(folder / (material.at("name").get<std::string>() + ".yaml"), {material.at("yaml").get<std::string>()});
}

Fit read_with_warnings(const std::string& file) {
  const Config config = Config::from_file(file);
  Fit fit = read_fit(config);
  for (const auto& warning : config.warnings()) fmt::print(stderr, "warning: {}\n", warning);
  return fit;
}

int run(const StudyArguments& arguments) {
  use_one_thread_each();
  const Fit fit = read_with_warnings(arguments.file);
  const Problem problem(fit);
  const fs::path folder = folder_for(arguments, "out/fits", fit.name);
  InputWarningPrinter warnings;
  for (const PreparedExperiment& experiment : problem.experiments())
    warnings.print(experiment.scene, !experiment.has_modes_only());
  const StudyFolder place(folder, "fit", arguments.file);
  Printer printer(problem, arguments.quiet);
  const JobOptions options{
      folder, job_queue(arguments, worker_count(arguments)),
      [&](std::size_t count, const Job&, const EvaluationResult&, bool cached) { printer.run(count, cached); }};
  if (!arguments.quiet)
    fmt::print("{}, {}\n", counted(std::ssize(problem.data()), "measured value"),
               counted(std::ssize(problem.parameters()), "parameter"));
  Json table;
  try {
    table = fit_json(fit, problem,
                     run_fit(problem, fit, options,
                             {.on_iteration = [&](std::size_t, const Iteration& one) { printer.iteration(one); },
                              .on_stage = [&](const std::string& stage) { printer.stage(stage); }}),
                     arguments.file);
  } catch (const Interrupted&) {
    print_interrupted("runs", folder);
    return 130;
  }
  write_results(folder, table);
  for (const Json& warning : table.at("warnings")) fmt::print(stderr, "warning: {}\n", warning.get<std::string>());
  if (!arguments.quiet) fmt::print("\n{}table   {}\n", fit_text(table), (folder / "parameters.csv").string());
  show_report(folder, arguments);
  const Json& best = table.at("attempts").at(table.at("best").get<std::size_t>());
  return best.at("converged").get<bool>() ? 0 : 3;
}

void declare(StudyArguments& arguments, CommandOptions& options) {
  declare_study(arguments, options, {"fit", "A fit in YAML.", "fits", "fit", "runs"});
  declare_jobs(arguments, options, "runs");
}

const CommandRegistration fit_command(
    {.order = 57,
     .name = "fit",
     .sentence = "Find stiffnesses, angles or damping that explain measured values, with confidence intervals. Run it "
                 "again to continue.",
     .examples = R"(
  orthodyn fit configs/fits/spruce_plate.yaml
  orthodyn fit mine.yaml --jobs 4)"},
    declare, run);

}  // namespace

}  // namespace orthodyn::study::fit
