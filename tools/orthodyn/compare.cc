// `orthodyn compare`: carries a comparison out and has its report drawn.
#include <fmt/format.h>

#include <filesystem>

#include "lib/simulation/files.h"
#include "lib/study/compare/comparison_table.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/draw.h"
#include "tools/orthodyn/failures.h"
#include "tools/orthodyn/interrupt.h"
#include "tools/orthodyn/study_folder.h"
#include "tools/orthodyn/study_options.h"
#include "tools/orthodyn/teller.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

constexpr const char* kTable = "compare.json";

std::string outcome_of(const Json& result) {
  if (result.at("status") != "completed") return "failed: " + result.at("reason").get<std::string>();
  std::string text = "done";
  if (result.contains("wall")) text = fmt::format("{:.3g} s", result.at("wall").at("median").get<double>());
  if (result.contains("kind") && result.at("kind") == "exact") text = "exact solution";
  if (result.contains("errors") && result.at("errors").at("displacement").at("l2").is_number())
    text += fmt::format(", error {:.2g}", result.at("errors").at("displacement").at("l2").get<double>());
  return text;
}

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

int compare(const StudyArguments& arguments) {
  const Config config = Config::from_file(arguments.file);
  const Comparison comparison = read_comparison(config);
  Design design = expand(comparison);
  const StudyFolder place(arguments.out ? fs::path(*arguments.out) : fs::path("out/comparisons") / comparison.name,
                          "comparison", arguments.file);
  const fs::path& folder = place.path();

  Teller teller;
  std::size_t kept = 0;
  const auto notify = [&](const TaskNotice& notice) {
    kept += !notice.starts && notice.cached && met_a_limit(*notice.result);
    if (!arguments.quiet && !notice.starts)
      teller.tell(notice.count, notice.title, outcome_of(*notice.result), notice.cached);
  };
  Campaign campaign(comparison, std::move(design), {folder, fs::read_symlink("/proc/self/exe").string(), notify,
                     arguments.retry ? OldFailures::retry : OldFailures::keep});
  Json table;
  catch_interrupts();
  const bool complete = campaign.run(interrupted(), [&] {
    table = comparison_json(campaign, arguments.file);
    write_file(folder / kTable, {to_text(table, 1)});
    write_file(folder / "compare.csv", {comparison_csv(table)});
  });
  if (!complete)
    fmt::print(stderr, "interrupted; the finished points are in {} and will not be done again\n", folder.string());
  if (!arguments.quiet && !table.is_null()) print_answers(table);
  if (arguments.no_report) put_report_aside(folder, arguments.quiet);
  else if (!table.is_null()) draw_report(folder, arguments.quiet);
  Failures failures;
  for (const auto& [i, result] : campaign.results())
    failures.add(title(campaign.design(), campaign.design().points[i]), result);
  failures.print();
  tell_of_kept_limits(kept);
  return complete ? failures.exit_code() : 130;
}

void declare(StudyArguments& arguments, CommandOptions& options) {
  declare_study(arguments, options, {"comparison", "A comparison in YAML.", "comparisons", "compare", "points"});
}

const CommandRegistration kRegistration(
    {.order = 40,
     .name = "compare",
     .sentence = "Compare integrators on scenes: error against time, as a report, CSV and JSON. Run again, it goes on.",
     .examples = R"(
  orthodyn compare configs/comparisons/damped_beam.yaml
  orthodyn compare mine.yaml --retry           once more, with what failed)"},
    declare, compare);

}  // namespace

}  // namespace orthodyn
