// orthodyn: the command line.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "lib/core/errors.h"
#include "lib/core/versions.h"
#include "lib/mesh/io/mesh_format.h"
#include "tools/orthodyn/commands.h"
#include "tools/orthodyn/plugins.h"

namespace {

constexpr const char* kExamples = R"(
Examples:
  orthodyn run configs/scenes/cantilever.yaml
  orthodyn run configs/scenes/free_flight.yaml --set elasticity.corotation=warped --out out/warped
  orthodyn run configs/scenes/laminate.yaml --set checkpoint={} --resume
  orthodyn check configs/scenes/laminate.yaml
  orthodyn modes configs/scenes/tuning_fork.yaml -n 8
  orthodyn init scene my.yaml
  orthodyn list materials
  orthodyn compare configs/comparisons/damped_beam.yaml
  orthodyn sweep configs/sweeps/grain_angle.yaml
  orthodyn stability configs/stability/hard_cases.yaml
  orthodyn verify configs/cases

Exit codes: 0 done, 1 an expectation was missed, 2 the input is at fault (nothing was written), 3 the run could not go on (what
was computed is kept), or no point of a comparison or sweep could be computed, 130 interrupted (likewise).)";

void add_scene_options(CLI::App& command, orthodyn::RunArguments& arguments) {
  command.add_option("scene", arguments.scene, "A scene in YAML.")->required()->type_name("SCENE.yaml");
  command.add_option("--set", arguments.set, "Change a value by its path, e.g. materials.wood.young.0=12e9.")
      ->type_name("PATH=VALUE")
      ->expected(1)
      ->take_all();
  command.add_option("--integrator", arguments.integrator, "Short for --set integrator.type=NAME.");
}

// What `add_study_options` says of a study.
struct StudyWords {
  const char *name, *sentence;  // of its file
  const char* folder;           // below out/
  const char *table, *pieces;
};

void add_study_options(CLI::App& command, orthodyn::StudyArguments& arguments, const StudyWords& words) {
  command.add_option(words.name, arguments.file, words.sentence)->required()->type_name("FILE.yaml");
  command.add_option("--out", arguments.out, fmt::format("Folder for the results; default out/{}/<name>.", words.folder))
      ->type_name("DIR");
  command.add_flag("--retry", arguments.retry, fmt::format("Try {} again that failed in an earlier run.", words.pieces));
  command.add_flag("--quiet", arguments.quiet, "Say nothing but errors.");
  command.add_flag("--no-report", arguments.no_report, fmt::format("Write {0}.json and {0}.csv only.", words.table));
}

void add_jobs(CLI::App& command, orthodyn::StudyArguments& arguments, const char* pieces) {
  command
      .add_option("--jobs", arguments.jobs, fmt::format("{} at a time, each in a process; default one a processor.", pieces))
      ->check(CLI::Range(1, 1024));
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

  std::vector<std::string> plugins;
  app.add_option("--plugin", plugins, "A shared library with materials, terms, integrators or meshes of your own.")
      ->type_name("FILE.so")
      ->expected(1)
      ->take_all();

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

  run->footer(R"(
Examples:
  orthodyn run configs/scenes/cantilever.yaml --set integrator.rtol=1e-5 --out out/fine
  orthodyn run configs/scenes/laminate.yaml --set checkpoint={} --resume)");

  auto* check = app.add_subcommand("check", "Read, validate and build a scene, and say what it consists of.");
  add_scene_options(*check, arguments);
  auto* axes = check->add_flag("--axes", arguments.axes, "Also write the material axes: axes.vtu and a picture, axes.png.");
  check->add_option("--out", arguments.out, "Folder for the axes; default out/axes/<scene>.")->type_name("DIR")->needs(axes);

  check->footer(R"(
Examples:
  orthodyn check configs/scenes/laminate.yaml
  orthodyn check configs/scenes/laminate.yaml --axes)");

  ModesArguments vibration;
  auto* modes = app.add_subcommand("modes", "Natural frequencies and shapes of a scene's body, without damping.");
  modes->add_option("scene", vibration.scene, "A scene in YAML.")->required()->type_name("SCENE.yaml");
  modes->add_option("-n,--count", vibration.count, "How many, the lowest first, rigid ones included.")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  modes->add_flag("--equilibrium", vibration.equilibrium, "About the static equilibrium under the scene's loads, not about rest.");
  modes->add_option("--out", vibration.out, "Folder for the results; default out/modes/<scene>.")->type_name("DIR");
  modes->add_flag("--force", vibration.force, "Replace earlier modes in the folder.");
  modes->add_flag("--quiet", vibration.quiet, "No table and no picture.");
  modes->add_option("--set", vibration.set, "Change a value by its path.")->type_name("PATH=VALUE")->expected(1)->take_all();

  modes->footer(R"(
Examples:
  orthodyn modes configs/scenes/tuning_fork.yaml -n 8)");

  CompareArguments comparison;
  auto* compare = app.add_subcommand(
      "compare", "Compare integrators on scenes: error against time, as a report, CSV and JSON. Run again, it goes on.");
  add_study_options(*compare, comparison, {"comparison", "A comparison in YAML.", "comparisons", "compare", "points"});
  compare->footer(R"(
Examples:
  orthodyn compare configs/comparisons/damped_beam.yaml
  orthodyn compare mine.yaml --retry           once more, with what failed)");

  std::string folder;
  auto* measure = app.add_subcommand("measure", "One point of a comparison; called by compare.")->group("");
  measure->add_option("folder", folder)->required();

  SweepArguments variation;
  auto* sweep = app.add_subcommand(
      "sweep", "Figures of a scene over varied values, as a report, CSV and JSON. Run again, it goes on.");
  add_study_options(*sweep, variation, {"sweep", "A sweep in YAML.", "sweeps", "sweep", "points"});
  add_jobs(*sweep, variation, "Points");
  auto* task = sweep->add_option("--task", variation.task, "Do the I-th of N parts of the points only; for job arrays.")
                   ->type_name("I/N");
  auto* slurm = sweep->add_option("--slurm", variation.slurm, "The sweep as a job array of SLURM: print its script, or submit it.")
                    ->check(CLI::IsMember({"print", "submit"}))
                    ->expected(0, 1)
                    ->default_str("print")
                    ->excludes(task);
  sweep->add_option("--tasks", variation.tasks, "Tasks of the array; default one a point, up to 1000.")
      ->check(CLI::Range(1, 1000000))
      ->needs(slurm);
  sweep->add_flag("--collect", variation.collect, "Join the points that are there, and say which are missing.")
      ->excludes(task)
      ->excludes(slurm)
      ->excludes(sweep->get_option("--retry"));
  sweep->footer(R"(
Examples:
  orthodyn sweep configs/sweeps/grain_angle.yaml
  orthodyn sweep mine.yaml --slurm --tasks 100 > array.sh; sbatch array.sh
  orthodyn sweep mine.yaml --collect           join what the tasks have done)");

  auto* evaluate = app.add_subcommand("evaluate", "One point of a sweep; called by sweep.")->group("");
  evaluate->add_option("folder", folder)->required();

  StabilityArguments hard;
  auto* stability = app.add_subcommand(
      "stability", "Try integrators on hard cases: a matrix of pass, degraded and fail, with reasons. Run again, it goes on.");
  add_study_options(*stability, hard, {"cases", "Hard cases in YAML.", "stability", "stability", "trials"});
  add_jobs(*stability, hard, "Trials");
  stability->footer(R"(
Examples:
  orthodyn stability configs/stability/hard_cases.yaml --jobs 2
  orthodyn stability mine.yaml --retry         once more, with what failed)");
  auto* assess = app.add_subcommand("assess", "One trial of a matrix; called by stability.")->group("");
  assess->add_option("folder", folder)->required();

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

  verify->footer(R"(
Examples:
  orthodyn verify configs/cases
  orthodyn verify mine.yaml --integrator tr_bdf2)");

  ConvertArguments conversion;
  auto* convert = app.add_subcommand(
      "convert", "A mesh from one format to another, by the endings: " + known_mesh_endings() + ".");
  convert->add_option("in", conversion.in, "The mesh to read.")->required()->type_name("IN");
  convert->add_option("out", conversion.out, "The mesh to write; what its format cannot hold is said.")->required()->type_name("OUT");
  convert->add_option("--scale", conversion.scale, "Multiplies coordinates: 0.001 from mm to m.")->type_name("FACTOR");
  convert->add_flag("--force", conversion.force, "Replace files that are there already.");

  convert->footer(R"(
Examples:
  orthodyn convert part.msh part.vtu
  orthodyn convert part.inp part.msh --scale 0.001)");

  std::string what;
  auto* list = app.add_subcommand("list", "What can be named in a scene, each with its keys.");
  list->add_option("what", what, "scene, materials, presets, meshes, axes, integrators, solvers, terms, factors, statics, events, expect, comparison, sweep, stability, fields; all if left out.");
  bool markdown = false;
  list->add_flag("--markdown", markdown, "Every key of the input as one page in Markdown.");

  list->footer(R"(
Examples:
  orthodyn list materials
  orthodyn list --markdown > reference.md)");

  std::string schema_kind;
  auto* schema = app.add_subcommand("schema", "The JSON Schema of the input, for editors that complete and check YAML.");
  schema->add_option("kind", schema_kind, "scene, comparison, sweep or stability; all in one schema if left out.");

  schema->footer(R"(
Examples:
  orthodyn schema scene > scene.json)");

  std::string start_kind;
  std::optional<std::string> start_file;
  auto* init = app.add_subcommand("init", "Write a commented file to start from.");
  init->add_option("kind", start_kind, "scene, static, comparison, sweep or stability.")->required();
  init->add_option("file", start_file, "Its name; default KIND.yaml.")->type_name("FILE.yaml");

  init->footer(R"(
Examples:
  orthodyn init scene my.yaml
  orthodyn init sweep)");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const int code = app.exit(e);
    return code == 0 ? 0 : 2;
  }

  try {
    load_plugins(plugins);
    if (*run) return run_command(arguments);
    if (*check) return check_command(arguments);
    if (*modes) return modes_command(vibration);
    if (*convert) return convert_command(conversion);
    if (*compare) return compare_command(comparison);
    if (*measure) return measure_command(folder);
    if (*sweep) return sweep_command(variation);
    if (*evaluate) return evaluate_command(folder);
    if (*stability) return stability_command(hard);
    if (*assess) return assess_command(folder);
    if (*verify) return verify_command(cases);
    if (*schema) return schema_command(schema_kind);
    if (*init) return init_command(start_kind, start_file);
    return list_command(what, markdown);
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
