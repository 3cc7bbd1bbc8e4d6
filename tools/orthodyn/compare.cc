// `orthodyn compare`: carries a comparison out and has its report drawn.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "lib/run/files.h"
#include "lib/study/comparison_table.h"
#include "lib/study/measure.h"
#include "tools/orthodyn/commands.h"
#include "tools/orthodyn/comparison_folder.h"
#include "tools/orthodyn/draw.h"
#include "tools/orthodyn/interrupt.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

constexpr const char* kTable = "compare.json";

// A line for each point, and how long the rest may take.
class Teller {
 public:
  void operator()(const TaskNotice& notice) {
    if (notice.starts) {
      began_ = Clock::now();
      return;
    }
    fmt::print("[{:>{}}/{}] {}: {}", notice.number, std::to_string(notice.count).size(), notice.count, notice.title,
               outcome(*notice.result));
    if (notice.cached) fmt::print(" (done before)");
    else tell_time_left(notice);
    fmt::print("\n");
    std::fflush(stdout);
  }

 private:
  using Clock = std::chrono::steady_clock;

  static std::string outcome(const Json& result) {
    if (result.at("status") != "completed") return "failed: " + result.at("reason").get<std::string>();
    std::string text = "done";
    if (result.contains("wall")) text = fmt::format("{:.3g} s", result.at("wall").at("median").get<double>());
    if (result.contains("kind") && result.at("kind") == "exact") text = "exact solution";
    if (result.contains("errors") && result.at("errors").at("displacement").at("l2").is_number())
      text += fmt::format(", error {:.2g}", result.at("errors").at("displacement").at("l2").get<double>());
    return text;
  }

  void tell_time_left(const TaskNotice& notice) {
    spent_ += std::chrono::duration<double>(Clock::now() - began_).count();
    ++done_;
    const double left = spent_ / done_ * static_cast<double>(notice.count - notice.number);
    if (left >= 60) fmt::print("  ({:.0f} min left)", left / 60);
    else if (left >= 5) fmt::print("  ({:.0f} s left)", left);
  }

  Clock::time_point began_;
  double spent_ = 0;
  int done_ = 0;
};

std::string label_of(const Json& list, const Json& id) {
  for (const auto& item : list)
    if (item.at("id") == id) return item.at("label");
  return id;
}

void print_answers(const Json& table) {
  for (const auto& problem : table.at("problems")) {
    const Json& reference = problem.at("reference");
    if (reference.at("kind") == "computed" && !reference.at("checked").get<bool>())
      fmt::print("the reference of {} could not be checked, so its error is unknown: no answers\n",
                 problem.at("label").get<std::string>());
  }
  for (const auto& answer : table.at("answers")) {
    fmt::print("error {:g} on {}:", answer.at("target").get<double>(), label_of(table.at("problems"), answer.at("problem")));
    const char* separator = " ";
    for (const auto& row : answer.at("methods")) {
      if (row.at("seconds").is_null()) continue;
      fmt::print("{}{} {:.3g} s", separator, label_of(table.at("methods"), row.at("method")), row.at("seconds").get<double>());
      separator = ", ";
    }
    fmt::print("\n");
  }
}

}  // namespace

int compare_command(const CompareArguments& arguments) {
  const Config config = Config::from_file(arguments.comparison);
  const Comparison comparison = read_comparison(config);
  Design design = expand(comparison);
  const ComparisonFolder place(arguments.out ? fs::path(*arguments.out)
                                             : fs::path("out/comparisons") / comparison.name);
  const fs::path& folder = place.path();

  Teller teller;
  const auto notify = [&](const TaskNotice& notice) {
    if (!arguments.quiet) teller(notice);
  };
  Campaign campaign(comparison, std::move(design), {folder, fs::read_symlink("/proc/self/exe").string(), notify});
  Json table;
  heed_interrupts();
  const bool complete = campaign.run(interrupted(), [&] {
    table = comparison_json(campaign, arguments.comparison);
    write_file(folder / kTable, {to_text(table, 1)});
    write_file(folder / "compare.csv", {comparison_csv(table)});
  });
  if (!complete)
    fmt::print(stderr, "interrupted; the finished points are in {} and will not be done again\n", folder.string());
  if (!arguments.quiet && !table.is_null()) print_answers(table);
  if (!arguments.no_report && !table.is_null()) draw_report(folder, arguments.quiet);
  return complete ? 0 : 130;
}

int measure_command(const std::string& folder) {
  measure(folder);
  return 0;
}

}  // namespace orthodyn
