// `orthodyn stability`: grades integrators on hard cases by the cases' expectations.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <map>

#include "lib/simulation/output/files.h"
#include "lib/study/jobs/json_values.h"
#include "lib/study/stability/stability_matrix.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/study_command.h"
#include "tools/orthodyn/study_messages.h"

namespace orthodyn::study::stability {

namespace fs = std::filesystem;

namespace {

constexpr auto kBetweenTables = std::chrono::seconds(10);

std::string outcome_of(const StabilityResult& result) {
  std::string text = result.grade();
  if (result.run) text += fmt::format(" in {:.2g} s", result.run->wall_seconds);
  if (const std::string reason = result.reason(); !reason.empty()) text += ": " + reason;
  return text;
}

std::string symbol(const std::string& grade) {
  static const std::map<std::string, std::string> symbols{
      {"pass", "+"}, {"degraded", "o"}, {"fail", "X"}, {"refused", "-"}};
  return symbols.at(grade);
}

// Prints a table for each variant: rows are cases, columns are integrators, which are numbered in a list above.
class MatrixTable {
 public:
  explicit MatrixTable(const Json& matrix) : matrix_(matrix) {
    for (const auto& run : matrix.at("trials"))
      grades_[{run.at("variant"), run.at("case"), run.at("integrator")}] = run.at("grade");
    const auto fit = [&](const std::string& text) { width_ = std::max(width_, text.size()); };
    for (const auto& hard : matrix.at("cases")) fit(hard.at("label"));
    for (const auto& variant : matrix.at("variants")) fit(variant);
  }

  void print() const {
    fmt::print("\n+ pass   o degraded   X fail   - refused by the integrator{}\n",
               matrix_.at("complete").get<bool>() ? "" : "   ? not run yet");
    std::size_t column = 0;
    for (const auto& integrator : matrix_.at("integrators"))
      fmt::print("{:>3} {}\n", ++column, integrator.get<std::string>());
    for (const auto& variant : matrix_.at("variants")) print(variant);
    for (const auto& suspicion : matrix_.at("suspected")) fmt::print("\n{}\n", suspicion.get<std::string>());
  }

 private:
  void print(const std::string& variant) const {
    fmt::print("\n{:<{}}", variant, width_);
    for (std::size_t i = 1; i <= matrix_.at("integrators").size(); ++i) fmt::print(" {:>2}", i);
    fmt::print("\n");
    for (const auto& hard : matrix_.at("cases")) {
      fmt::print("{:<{}}", hard.at("label").get<std::string>(), width_);
      for (const auto& integrator : matrix_.at("integrators")) {
        const auto found = grades_.find({variant, hard.at("label"), integrator});
        fmt::print(" {:>2}", found == grades_.end() ? "?" : symbol(found->second));
      }
      const std::string model = hard.at("model");
      fmt::print("{}\n", model.empty() ? "" : "   model: " + model);
    }
    fmt::print("{:<{}}", "fails", width_);
    for (const auto& integrator : matrix_.at("integrators")) fmt::print(" {:>2}", fails(variant, integrator));
    fmt::print("\n");
  }

  std::ptrdiff_t fails(const std::string& variant, const std::string& integrator) const {
    return std::count_if(grades_.begin(), grades_.end(), [&](const auto& entry) {
      return entry.first[0] == variant && entry.first[2] == integrator && entry.second == "fail";
    });
  }

  const Json& matrix_;
  std::map<std::array<std::string, 3>, std::string> grades_;  // by variant, case, integrator
  std::size_t width_ = 5;
};

int try_stability(const StudyArguments& arguments) {
  use_one_thread_each();  // called first, because the number of threads is part of the fingerprints
  Stability stability = read_stability(Config::from_file(arguments.file));
  const fs::path out = folder_for(arguments, "out/stability", stability.name);
  StabilityMatrix matrix(std::move(stability), out);
  const StudyFolder place(out, "stability", arguments.file);

  const auto write_table = [&] {
    Json table = matrix.json(arguments.file);
    write_file(out / "stability.json", {to_text(table, 1)});
    write_file(out / "stability.csv", {matrix.csv()});
    return table;
  };
  ProgressReporter reporter(arguments.quiet);
  auto next_table = std::chrono::steady_clock::now() + kBetweenTables;
  const auto after_each = [&](std::size_t run, const StabilityResult& result, bool cached) {
    reporter.report(matrix.runs().size(), matrix.runs()[run].title, outcome_of(result), cached);
    if (std::chrono::steady_clock::now() < next_table) return;
    write_table();
    next_table = std::chrono::steady_clock::now() + kBetweenTables;
  };
  const std::size_t kept = arguments.retry ? 0 : number_at_limits(matrix.jobs());
  const bool complete = matrix.run(job_queue(arguments, worker_count(arguments)), after_each);
  const Json table = write_table();
  if (!complete) print_interrupted("trials", out);
  if (!arguments.quiet) MatrixTable(table).print();
  show_report(out, arguments);
  print_kept_failures(kept);
  return complete ? 0 : 130;
}

void declare_stability(StudyArguments& arguments, CommandOptions& options) {
  declare_study(arguments, options, {"cases", "A list of hard cases in YAML.", "stability", "stability", "trials"});
  declare_jobs(arguments, options, "trials");
}

const CommandRegistration stability_command(
    {.order = 60,
     .name = "stability",
     .sentence =
         "Test integrators on hard cases: a matrix of pass, degraded and fail, with reasons. Run it again to continue.",
     .examples = R"(
  orthodyn stability configs/stability/hard_cases.yaml --jobs 2
  orthodyn stability mine.yaml --retry         also repeat what failed)"},
    declare_stability, try_stability);

}  // namespace

}  // namespace orthodyn::study::stability
