// `orthodyn compare`: runs a comparison of integrators and draws its report.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "lib/core/spelling.h"
#include "lib/simulation/error_estimate/mesh_error.h"
#include "lib/simulation/output/files.h"
#include "lib/simulation/run/several_ranks.h"
#include "lib/study/compare/comparison_table.h"
#include "lib/study/compare/measurement.h"
#include "lib/study/jobs/json_values.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/study_command.h"
#include "tools/orthodyn/study_messages.h"

namespace orthodyn::study::compare {

namespace fs = std::filesystem;

namespace {

std::string outcome_of(const MeasurementResult& result) {
  if (result.failure) return "failed: " + result.failure->reason;
  std::string text = "done";
  if (result.wall) text = fmt::format("{:.3g} s", result.wall->median);
  if (result.kind == MeasurementResult::Kind::exact) text = "exact solution";
  if (result.errors && std::isfinite(result.errors->displacement.l2))
    text += fmt::format(", error {:.2g}", result.errors->displacement.l2);
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
      fmt::print("the reference of {} could not be checked: its error is unknown, so no times per error are given\n",
                 problem.at("label").get<std::string>());
  }
  for (const auto& answer : table.at("answers")) {
    fmt::print("error {:g} on {}:", answer.at("target").get<double>(),
               label_of(table.at("problems"), answer.at("problem")));
    const char* separator = " ";
    for (const auto& row : answer.at("methods")) {
      if (row.at("seconds").is_null()) continue;
      fmt::print("{}{} {:.3g} s", separator, label_of(table.at("methods"), row.at("method")),
                 row.at("seconds").get<double>());
      separator = ", ";
    }
    fmt::print("\n");
  }
  for (const auto& front : table.at("pareto_fronts"))
    for (const auto& answer : front.at("answers"))
      fmt::print("{} {}\n", front.at("label").get<std::string>(), answer.at("words").get<std::string>());
}

// Prints the failures of references, without which no errors are known.
void print_failed_references(const ComparisonRun& run) {
  for (const auto& [group, reference] : run.references()) {
    const auto& failure = reference.check ? reference.check->failure : reference.result.failure;
    if (!failure) continue;
    fmt::print(stderr, "{} of {} failed: {}: {}\n", reference.check ? "the check of the reference" : "the reference",
               run.design().groups[group].label, failure->reason, failure->message);
  }
}

// The scene of the first point of each problem, because input warnings do not depend on the method.
std::vector<Config> scenes_of(const Design& design) {
  std::vector<Config> scenes;
  std::set<std::size_t> seen;
  for (const Point& point : design.points)
    if (seen.insert(point.problem).second) scenes.push_back(point_scene(design, point));
  return scenes;
}

// Prints each input warning once. Called before any point is computed. Throws ConfigError if a scene lacks a quantity
// or a field that the comparison wants.
void check_scenes(const Comparison& comparison, const Config& config, const std::vector<Config>& scenes) {
  if (comparison.quantities.empty() && !comparison.frames) {
    InputWarningPrinter printer;
    for (const Config& scene : scenes) printer.print(scene);
    return;
  }
  std::set<std::string> warnings;  // printed once all scenes are valid
  for (const Config& scene : scenes) {
    const Setup setup = set_up(scene);
    followed_quantities(setup, comparison.quantities, {config.at("quantities").where()});
    warnings.insert(setup.built.warnings.begin(), setup.built.warnings.end());
  }
  for (const auto& warning : warnings) fmt::print(stderr, "warning: {}\n", warning);
}

// Leaves out the integrators from `all` that cannot run on several ranks. Throws ConfigError for a named one.
Comparison for_ranks(Comparison comparison) {
  std::vector<std::string> left_out;
  std::erase_if(comparison.integrators, [&](const IntegratorEntry& entry) {
    if (Registry<IntegratorChoice>::entries().at(entry.type).make()->runs_on_ranks()) return false;
    if (!entry.by_all)
      entry.origin.fail("'" + entry.type + "' does not run on several ranks: remove this entry or --ranks");
    left_out.push_back(entry.type);
    return true;
  });
  if (!left_out.empty())
    fmt::print(stderr, "notice: left out, since they do not run on several ranks: {}\n", join(left_out));
  return comparison;
}

void require_points_to_run_on_ranks(const Design& design) {
  for (const Point& point : design.points) {
    Config config = point_scene(design, point).resolving();
    Scene scene = read_scene(config);
    adapt_to_ranks(config, scene);
  }
}

// Warns of coarse meshes shared by reference and points, whose errors do not include the discretisation error.
void warn_of_shared_meshes(const Json& table) {
  for (const Json& problem : table.at("problems")) {
    const Json& reference = problem.at("reference");
    const Json error = reference.value("shared_mesh_error", Json());
    if (!error.is_number() || !(error > kCoarseMesh)) continue;
    fmt::print(stderr,
               "warning: {}: errors are time integration errors only; reference and points share a mesh error of about "
               "{:.2g} of the elastic energy, so smaller time errors do not make results more accurate\n",
               problem.at("label").get<std::string>(), error.get<double>());
  }
}

int compare(const StudyArguments& arguments) {
  require_ranks(arguments);
  const Config config = Config::from_file(arguments.file);
  const Comparison comparison = arguments.ranks > 1 ? for_ranks(read_comparison(config)) : read_comparison(config);
  require_usual_number(arguments, number_of_points(comparison));
  Design design = expand(comparison);
  if (arguments.ranks > 1) require_points_to_run_on_ranks(design);
  check_scenes(comparison, config, scenes_of(design));
  const StudyFolder place(folder_for(arguments, "out/comparisons", comparison.name), "comparison", arguments.file);
  const fs::path& folder = place.path();

  ProgressReporter reporter(arguments.quiet);
  std::size_t kept = 0;
  ComparisonRun run(comparison, std::move(design), folder, arguments.ranks, [&](const Progress& progress) {
    kept += progress.cached && met_a_limit(progress.result.failure);
    reporter.report(progress.count, progress.title, outcome_of(progress.result), progress.cached);
  });
  Json table;
  const bool complete = run.run(job_queue(arguments, 1), [&] {
    table = comparison_json(run, arguments.file);
    write_file(folder / "compare.json", {to_text(table, 1)});
    write_file(folder / "compare.csv", {comparison_csv(table)});
  });
  if (!complete) print_interrupted("points", folder);
  if (!arguments.quiet && !table.is_null()) print_answers(table);
  if (arguments.no_report || !table.is_null()) show_report(folder, arguments);
  if (!table.is_null()) warn_of_shared_meshes(table);
  print_failed_references(run);
  FailureSummary failures;
  for (const auto& [i, result] : run.results())
    failures.add(title(run.design(), run.design().points[i]), result.failure);
  failures.print();
  print_kept_failures(kept);
  return complete ? failures.exit_code() : 130;
}

void declare_comparison(StudyArguments& arguments, CommandOptions& options) {
  declare_study(arguments, options, {"comparison", "A comparison in YAML.", "comparisons", "compare", "points"});
  declare_ranks(arguments, options, "point");
  declare_yes(arguments, options);
}

const CommandRegistration compare_command(
    {.order = 40,
     .name = "compare",
     .sentence = "Compare integrators on scenes, error against time: report, CSV and JSON. Run it again to continue.",
     .examples = R"(
  orthodyn compare configs/comparisons/damped_beam.yaml
  orthodyn compare configs/comparisons/space_and_time.yaml   meshes and methods: total error and Pareto front
  orthodyn compare mine.yaml --retry           also repeat what failed)"},
    declare_comparison, compare);

}  // namespace

}  // namespace orthodyn::study::compare
