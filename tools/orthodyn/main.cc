// orthodyn: the command line.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "lib/core/errors.h"
#include "lib/core/versions.h"
#include "tools/orthodyn/commands.h"

namespace {

constexpr const char* kExamples = R"(
Examples:
  orthodyn run configs/scenes/cantilever.yaml
  orthodyn run configs/scenes/free_flight.yaml --set elasticity.corotation=warped --out out/warped
  orthodyn run configs/scenes/laminate.yaml --set checkpoint={} --resume
  orthodyn check configs/scenes/laminate.yaml
  orthodyn list materials
  orthodyn compare configs/comparisons/damped_beam.yaml
  orthodyn verify configs/cases

Exit codes: 0 done, 1 an expectation was missed, 2 the input is at fault (nothing was written), 3 the run could not go on (what
was computed is kept), 130 interrupted (likewise).)";

void add_scene_options(CLI::App& command, orthodyn::RunArguments& arguments) {
  command.add_option("scene", arguments.scene, "A scene in YAML.")->required()->type_name("SCENE.yaml");
  command.add_option("--set", arguments.set, "Change a value by its path, e.g. materials.wood.young.0=12e9.")
      ->type_name("PATH=VALUE")
      ->expected(1)
      ->take_all();
  command.add_option("--integrator", arguments.integrator, "Short for --set integrator.type=NAME.");
}

}  // namespace

int main(int argc, char** argv) {
  using namespace orthodyn;
#ifdef __GLIBC__
  // Large blocks go back to the system when freed: a fifth less memory at 84,000 elements.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
  CLI::App app("Dynamics of large-deformation orthotropic solids, driven by SUNDIALS.");
  app.footer(kExamples);
  app.require_subcommand(1);
  app.set_version_flag("--version", orthodyn_version());

  RunArguments arguments;
  auto* run = app.add_subcommand("run", "Run a scene: frames for ParaView, energies, steps, a summary.");
  add_scene_options(*run, arguments);
  run->add_option("--out", arguments.out, "Folder for the results; default out/<scene>.")->type_name("DIR");
  run->add_flag("--quiet", arguments.quiet, "No progress and no summary.");
  auto* force = run->add_flag("--force", arguments.force, "Replace an earlier result in the folder.");
  auto* resume = run->add_flag(
      "--resume", arguments.resume,
      "Go on from the checkpoint in the folder, or begin if there is no result yet. SCENE may be the folder.");
  resume->excludes(force);
  run->add_flag("--estimate-error", arguments.estimate_error,
                "Then repeat the run at rtol / 10 (or half the fixed step) and print the difference.")
      ->excludes(resume);

  auto* check = app.add_subcommand("check", "Read, validate and build a scene, and say what it consists of.");
  add_scene_options(*check, arguments);

  CompareArguments comparison;
  auto* compare = app.add_subcommand(
      "compare", "Compare integrators on scenes: error against time, as a report, CSV and JSON. Run again, it goes on.");
  compare->add_option("comparison", comparison.comparison, "A comparison in YAML.")
      ->required()
      ->type_name("COMPARISON.yaml");
  compare->add_option("--out", comparison.out, "Folder for the results; default out/comparisons/<name>.")->type_name("DIR");
  compare->add_flag("--quiet", comparison.quiet, "Say nothing but errors.");
  compare->add_flag("--no-report", comparison.no_report, "Write compare.json and compare.csv only.");

  std::string folder;
  auto* measure = app.add_subcommand("measure", "One point of a comparison; called by compare.")->group("");
  measure->add_option("folder", folder)->required();

  VerifyArguments cases;
  auto* verify = app.add_subcommand("verify", "Run scenes that expect known figures, and compare: exit code 1 on a miss.");
  verify->add_option("places", cases.places, "Scenes with an 'expect' list, or folders of them.")
      ->required()
      ->type_name("DIR|FILE");
  verify->add_option("--junit", cases.junit, "Also write the results as JUnit XML.")->type_name("FILE");
  verify->add_option("--set", cases.set, "Change a value in every case by its path.")
      ->type_name("PATH=VALUE")
      ->expected(1)
      ->take_all();
  verify->add_option("--integrator", cases.integrator, "Short for --set integrator.type=NAME.");

  std::string what;
  auto* list = app.add_subcommand("list", "What can be named in a scene, each with its keys.");
  list->add_option("what", what, "scene, materials, integrators, solvers, meshes, terms, factors, expect, comparison, fields; all if left out.");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const int code = app.exit(e);
    return code == 0 ? 0 : 2;
  }

  try {
    if (*run) return run_command(arguments);
    if (*check) return check_command(arguments);
    if (*compare) return compare_command(comparison);
    if (*measure) return measure_command(folder);
    if (*verify) return verify_command(cases);
    return list_command(what);
  } catch (const ConfigError& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return 2;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "error: out of memory; use a coarser mesh\n");
    return 3;
  } catch (const std::exception& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return 3;
  }
}
