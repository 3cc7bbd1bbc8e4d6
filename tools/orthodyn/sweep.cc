// `orthodyn sweep`: metrics of a scene for varied parameters.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "lib/core/units.h"
#include "lib/simulation/output/files.h"
#include "lib/study/jobs/json_values.h"
#include "lib/study/sweep/sweep_table.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/mpirun.h"
#include "tools/orthodyn/slurm.h"
#include "tools/orthodyn/study_command.h"
#include "tools/orthodyn/study_messages.h"
#include "tools/orthodyn/sweep_warnings.h"

namespace orthodyn::study::sweep {

namespace fs = std::filesystem;

namespace {

struct SweepArguments : StudyArguments {
  std::optional<std::string> task;   // "3/20": the third of 20 parts of the points
  std::optional<std::string> slurm;  // "print" or "submit"
  std::optional<std::size_t> tasks;  // number of tasks of the array
  bool collect = false;
};

// Reads "3/20" as {3, 20}.
std::pair<std::size_t, std::size_t> parse_task(const std::string& text) {
  std::size_t part = 0, parts = 0;
  char slash = 0, end = 0;
  if (std::sscanf(text.c_str(), "%zu%c%zu%c", &part, &slash, &parts, &end) != 3 || slash != '/' || part < 1 ||
      part > parts)
    throw ConfigError(fmt::format("--task: expected I/N with 1 <= I <= N, found '{}'", text));
  return {part, parts};
}

template <class T>
const T* value_of(const Named<T>& list, const std::string& name) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const auto& entry) { return entry.first == name; });
  return found == list.end() ? nullptr : &found->second;
}

// The metrics in the units given in the sweep, else in SI.
std::string outcome_of(const EvaluationResult& result, const Sweep& sweep) {
  if (result.failure) return "failed: " + result.failure->reason;
  std::vector<std::string> words;
  for (const auto& [name, metric] : sweep.quantities) {
    const double* value = value_of(result.metrics, name);
    if (!value || !std::isfinite(*value)) {
      words.push_back(name + " none");
      continue;
    }
    const std::string* si = value_of(result.units, name);
    const std::string unit = !metric.unit.empty() ? metric.unit : si ? *si : "";
    const double factor = metric.unit.empty() ? 1 : si_factor(metric.unit);
    words.push_back(
        fmt::format("{} {}{}", name, known_value(result, name, *value / factor), unit.empty() ? "" : " " + unit));
  }
  return join(words);
}

// Throws ConfigError for too many points and for metrics that cannot be computed on several ranks.
const Sweep& checked(const Sweep& sweep, const StudyArguments& arguments) {
  require_ranks(arguments);
  for (const auto& [name, metric] : sweep.quantities)
    if (arguments.ranks > 1 && !metric.is_of_motion())
      metric.origin.fail(
          "natural frequencies and buckling loads are computed by one process only: remove this quantity or --ranks");
  require_usual_number(arguments, number_of_points(sweep));
  return sweep;
}

Sweep read_with_warnings(const std::string& file) {
  const Config config = Config::from_file(file).resolving();
  Sweep sweep = read_sweep(config);
  for (const auto& warning : config.warnings()) fmt::print(stderr, "warning: {}\n", warning);
  return sweep;
}

class SweepCommand {
 public:
  explicit SweepCommand(const SweepArguments& arguments)
      : arguments_(arguments),
        sweep_(read_with_warnings(arguments.file)),
        points_(expand(checked(sweep_, arguments))),
        folder_(folder_for(arguments, "out/sweeps", sweep_.name)),
        jobs_(jobs_of(sweep_, points_, folder_, arguments.ranks)),
        work_(distinct(jobs_)) {}

  int execute() {
    if (arguments_.slurm) {
      warn_of_impossible_points(points_);
      InputWarningPrinter().print(first_scene(sweep_));
      return write_array();
    }
    if (arguments_.task) {
      const auto [part, parts] = parse_task(*arguments_.task);
      work_ = slice(work_, part, parts);
    }
    const bool alone = !arguments_.task && !arguments_.collect;
    const StudyFolder place(folder_, "sweep", arguments_.file, alone ? Sharing::exclusive : Sharing::shared);
    warn_of_impossible_points(points_);
    if (!arguments_.task && !arguments_.collect) InputWarningPrinter().print(first_scene(sweep_));
    if (!arguments_.task) results_ = results_of(work_);
    if (arguments_.collect) return collect();
    use_one_thread_each();
    const std::size_t kept = arguments_.retry ? 0 : number_at_limits(work_);
    const bool complete = run_jobs();
    if (!complete) print_interrupted("points", folder_);
    if (!arguments_.task) show();
    const FailureSummary failures = arguments_.task ? failures_of_task() : failures_of_points();
    failures.print();
    print_kept_failures(kept);
    if (!complete) return 130;
    return arguments_.task ? 0 : failures.exit_code();  // other tasks may succeed
  }

 private:
  int write_array() const {
    fs::create_directories(fs::absolute(folder_).parent_path());  // for the log of the tasks
    std::size_t tasks = arguments_.tasks.value_or(std::min<std::size_t>(work_.size(), 1000));
    if (tasks > work_.size()) {
      tasks = work_.size();
      fmt::print(stderr, "notice: {0} points need only {0} tasks, not {1}\n", tasks, *arguments_.tasks);
    }
    const ArrayJob job{this_program().string(),
                       fs::absolute(arguments_.file),
                       fs::absolute(folder_),
                       sweep_.name,
                       work_.size(),
                       tasks,
                       sweep_.limits,
                       arguments_.retry,
                       arguments_.ranks};
    if (*arguments_.slurm == "submit") submit_array(job);
    else fmt::print("{}", array_script(job));
    return 0;
  }

  bool run_jobs() {
    ProgressReporter reporter(arguments_.quiet);
    const JobEvents events{.starts = [&](std::size_t i) { results_.erase(work_[i].folder); },
                           .ends =
                               [&](std::size_t i, const Json& result, bool cached) {
                                 const EvaluationResult& evaluated = results_[work_[i].folder] =
                                     evaluation_from(result);
                                 reporter.report(work_.size(), work_[i].title, outcome_of(evaluated, sweep_), cached);
                                 if (!arguments_.task) write_table_if_due();
                               }};
    return job_queue(arguments_, worker_count(arguments_)).run(work_, events);
  }

  // Writes the table at most every 2 s, and so rarely that writing takes at most a tenth of the time.
  void write_table_if_due() {
    using Clock = std::chrono::steady_clock;
    const auto started = Clock::now();
    if (started < next_table_) return;
    write_table();
    const auto ended = Clock::now();
    next_table_ = ended + std::max<Clock::duration>(std::chrono::seconds(2), 10 * (ended - started));
  }

  Json write_table() const {
    Json table = sweep_json(sweep_, points_, jobs_, results_, arguments_.file, arguments_.ranks);
    write_file(folder_ / "sweep.json", {to_text(table, 1)});
    write_file(folder_ / "sweep.csv", {sweep_csv(table)});
    return table;
  }

  void show() const {
    warn_of_finished_points(write_table());
    if (!arguments_.quiet) fmt::print("table   {}\n", (folder_ / "sweep.csv").string());
    show_report(folder_, arguments_);
  }

  // Leaves out impossible points, which were reported before the run.
  FailureSummary failures_of_points() const {
    FailureSummary failures;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (jobs_[i]) add_result(*jobs_[i], failures);
    return failures;
  }

  FailureSummary failures_of_task() const {
    FailureSummary failures;
    for (const auto& job : work_) add_result(job, failures);
    return failures;
  }

  void add_result(const Job& job, FailureSummary& failures) const {
    if (const auto found = results_.find(job.folder); found != results_.end())
      failures.add(job.title, found->second.failure);
  }

  int collect() const {
    show();
    const FailureSummary failures = failures_of_points();
    failures.print();
    std::vector<std::string> missing;
    for (const auto& job : jobs_)
      if (job && !results_.contains(job->folder)) missing.push_back(job->title);
    if (missing.empty()) return failures.exit_code();
    constexpr std::size_t kListed = 20;
    fmt::print(stderr, "{} of {} points are missing:\n", missing.size(), points_.size());
    for (std::size_t i = 0; i < std::min(missing.size(), kListed); ++i) fmt::print(stderr, "  {}\n", missing[i]);
    if (missing.size() > kListed) fmt::print(stderr, "  ...\n");
    fmt::print(stderr, "to compute them, run the command without --collect or submit the array again\n");
    return 3;
  }

  const SweepArguments& arguments_;
  Sweep sweep_;
  std::vector<Point> points_;
  fs::path folder_;
  std::vector<std::optional<Job>> jobs_;  // by point; none for impossible points
  std::vector<Job> work_;                 // jobs of this command
  Results results_;                       // so far
  std::chrono::steady_clock::time_point next_table_;
};

void declare(SweepArguments& arguments, CommandOptions& options) {
  declare_study(arguments, options, {"sweep", "A sweep in YAML.", "sweeps", "sweep", "points"});
  declare_jobs(arguments, options, "points");
  declare_ranks(arguments, options, "point");
  declare_yes(arguments, options);
  options.value("--task", arguments.task, "Compute only the I-th of N parts of the points; used in job arrays.")
      .type("I/N");
  options
      .value("--slurm", arguments.slurm, "Print the script of a SLURM job array that computes the sweep, or submit it.")
      .choice({"print", "submit"})
      .excludes("--task");
  options.value("--tasks", arguments.tasks, "Number of tasks of the array; default: one per point, at most 1000.")
      .range(1, 1000000)
      .needs("--slurm");
  options
      .flag("--collect", arguments.collect,
            "Write tables and report from the finished points, and list the missing ones; after a job array.")
      .excludes("--task")
      .excludes("--slurm")
      .excludes("--retry");
}

int sweep(const SweepArguments& arguments) { return SweepCommand(arguments).execute(); }

const CommandRegistration sweep_command(
    {.order = 50,
     .name = "sweep",
     .sentence = "Compute metrics of a scene for varied parameters: report, CSV and JSON. Run it again to continue.",
     .examples = R"(
  orthodyn sweep configs/sweeps/grain_angle.yaml
  orthodyn sweep mine.yaml --slurm --tasks 100 > array.sh; sbatch array.sh
  orthodyn sweep mine.yaml --collect           after the array: tables and report)"},
    declare, sweep);

}  // namespace

}  // namespace orthodyn::study::sweep
