// `orthodyn verify`: runs scenes and compares results with their expectations.
#include "lib/study/quantities/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "lib/simulation/output/files.h"
#include "lib/simulation/run/scene_file.h"
#include "lib/simulation/run/setup.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/print_nothrow.h"

namespace orthodyn::study {

namespace fs = std::filesystem;

namespace {

struct VerifyArguments {
  std::vector<std::string> places;  // files and folders
  SceneChanges changes;
  std::optional<std::string> junit;
};

std::string case_name(const CaseResult& result) { return fs::path(result.file).stem().string(); }

// Column widths.
struct Widths {
  std::size_t name = 4, quantity = 8;
};

void print_head(const Widths& widths) {
  fmt::print("{:<{}}  {:<{}}  {:>12}  {:>12}  {:>10}  {:>8}\n", "case", widths.name, "quantity", widths.quantity,
             "target", "computed", "difference", "limit");
}

void print_result(const CaseResult& result, const Widths& widths) {
  for (const auto& check : result.checks)
    fmt::print("{:<{}}  {:<{}}  {:>12.6g}  {:>12.6g}  {:>10.2e}  {:>8.1e}  {}\n", case_name(result), widths.name,
               check.expectation.title(), widths.quantity, check.expectation.value.si(), check.computed,
               check.difference(), check.expectation.limit(), check.passed() ? "pass" : "MISS");
  if (!result.completed()) fmt::print("{:<{}}  {}\n", "", widths.name, result.outcome.message);
  for (const auto& check : result.checks)
    if (result.completed() && !check.passed())
      fmt::print("{:<{}}  {}: expected from {}; tolerance: {}\n", "", widths.name, check.expectation.title(),
                 check.expectation.source, check.expectation.reason);
  std::fflush(stdout);
}

struct Cases {
  std::vector<Config> configs;
  Widths widths;
  std::vector<CaseResult> unreadable;
};

// The result of a case with an input error. Prints the error.
CaseResult unreadable(const std::string& file, const ConfigError& error) {
  print_nothrow(fmt::format("error: {}\n", error.what()));
  CaseResult result{file, {}, {}};
  result.outcome.status = Outcome::Status::failed;
  result.outcome.message = error.what();
  return result;
}

void read_case(const std::string& file, const SceneChanges& changes, Cases& cases) {
  Config config = read_scene_file(file, changes);
  const Setup setup = set_up(config);
  for (const auto& warning : setup.built.warnings) print_nothrow(fmt::format("warning: {}\n", warning));
  const Scene& scene = setup.scene;
  require_expectations(scene, config);
  cases.widths.name = std::max(cases.widths.name, fs::path(file).stem().string().size());
  for (const auto& e : scene.expect) cases.widths.quantity = std::max(cases.widths.quantity, e.title().size());
  cases.configs.push_back(std::move(config));
}

// Reads and builds all cases before the first run, so that an error in the last file is found early.
Cases read_cases(const VerifyArguments& arguments) {
  Cases cases;
  for (const auto& place : arguments.places) {
    try {
      for (const auto& file : find_cases({place})) {
        try {
          read_case(file, arguments.changes, cases);
        } catch (const ConfigError& e) {
          cases.unreadable.push_back(unreadable(file, e));
        }
      }
    } catch (const ConfigError& e) {
      cases.unreadable.push_back(unreadable(place, e));
    }
  }
  return cases;
}

int verify_cases(const VerifyArguments& arguments) {
  const auto [configs, widths, faulty] = read_cases(arguments);
  if (arguments.junit) write_file(*arguments.junit, {junit_xml({})});  // throws here if the file cannot be written
  if (!configs.empty()) print_head(widths);
  std::vector<CaseResult> results = faulty;
  std::size_t missed = 0;
  double seconds = 0;
  for (const auto& config : configs) {
    results.push_back(study::verify(config));
    print_result(results.back(), widths);
    if (!results.back().passed()) ++missed;
    seconds += results.back().outcome.wall_seconds;
  }
  if (arguments.junit) write_file(*arguments.junit, {junit_xml(results)});
  fmt::print("{} of {} cases pass ({:.1f} s)", configs.size() - missed, configs.size(), seconds);
  if (!faulty.empty()) fmt::print("; {} could not be read", faulty.size());
  fmt::print("\n");
  if (missed)
    fmt::print(
        "run again with another integrator (--integrator NAME): if it computes the same, check the expectation\n");
  if (!faulty.empty()) return 2;
  return missed == 0 ? 0 : 1;
}

void declare(VerifyArguments& arguments, CommandOptions& options) {
  options.list("places", arguments.places, "Scenes with an 'expect' list, or folders of such scenes.")
      .required()
      .type("DIR|FILE");
  options.value("--junit", arguments.junit, "Also write the results as JUnit XML, for CI servers.").type("FILE");
  options.repeated("--set", arguments.changes.set, "Change a value of every scene by its path.").type("PATH=VALUE");
  options.value("--integrator", arguments.changes.integrator, "Run every scene with this integrator.");
}

const CommandRegistration verify_command(
    {.order = 70,
     .name = "verify",
     .sentence = "Run scenes and check their expectations: exit code 1 if one is missed, 2 for errors in a file.",
     .examples = R"(
  orthodyn verify configs/cases
  orthodyn verify mine.yaml --integrator tr_bdf2)"},
    declare, verify_cases);

}  // namespace

}  // namespace orthodyn::study
