// `orthodyn init`: writes a commented input file to start from.
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <optional>

#include "lib/core/errors.h"
#include "lib/core/file_kind.h"
#include "lib/core/spelling.h"
#include "lib/scene/abaqus_scene.h"
#include "lib/simulation/output/files.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/installed_paths.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

struct InitArguments {
  std::string kind;
  std::optional<std::string> file, from, units;
};

constexpr const char* kSceneHead = R"(# What this scene shows, in a sentence.
# Check it with `orthodyn check {file}`, run it with `orthodyn run {file}`.
# Numbers are in SI units; where a key has a unit, "11.9 GPa" or "25 mm" also work.
)";

constexpr const char* kBody = R"(
mesh:                      # all kinds: orthodyn list meshes
  type: box
  size: [1, 0.05, 0.02]    # m
  cells: [20, 2, 1]        # quadratic elements; order: 1 makes linear ones, which are stiff in bending

materials:                 # all kinds: orthodyn list materials
  wood:                    # axis 1 along the grain, 2 radial, 3 tangential
    type: orthotropic
    density: 400 kg/m^3
    young: [10.8 GPa, 0.84 GPa, 0.46 GPa]
    nu12: 0.44
    nu23: 0.44
    nu13: 0.53
    g12: 0.69 GPa
    g23: 0.032 GPa
    g13: 0.66 GPa

regions:                   # material and axes of each part of the mesh
  all:
    material: wood
    axes: {first: [1, 0, 0], second: [0, 1, 0]}
)";

constexpr const char* kMotion = R"(
damping: {stiffness: 1e-3} # s, proportional to the stiffness; leave it out for none
gravity: [0, 0, -9.81]     # m/s^2

clamps:
  - surface: x0            # a box has x0, x1, y0, y1, z0, z1

loads:
  - surface: x1
    force: [0, 0, -5]      # N in total
    factor: {type: ramp, end: 0.05}

time: {end: 1}             # s

integrator:                # all kinds: orthodyn list integrators
  type: cvode_bdf
  rtol: 1e-4               # local error, relative to the size of the motion

output:
  frames: 50
  fields: [displacement, velocity, nodal_stress]
  probes:
    tip: {at: [1, 0.025, 0.01]}

expect:                    # for `orthodyn verify` and `orthodyn stability`; see orthodyn list expect
  - quantity: energy.balance
    take: drift
    value: 0
    source: energy plus dissipation minus work of loads is constant
    absolute: 0.01
    reason: 100 rtol
)";

constexpr const char* kAnalysis =
    R"(analysis: static           # the equilibrium under all loads, which grow step by step
)";

constexpr const char* kRest = R"(
gravity: [0, 0, -9.81]     # m/s^2

clamps:                    # must hold all six rigid motions
  - surface: x0            # a box has x0, x1, y0, y1, z0, z1

loads:
  - surface: x1
    force: [0, 0, -5]      # N in total

statics:
  first_step: 0.25         # of the load factor, which grows from 0 to 1
  min_step: 1e-4           # how closely the end of a branch (snap-through, buckling) is found

output:                    # a frame and a row for each load step
  fields: [displacement, nodal_stress]
  probes:
    tip: {at: [1, 0.025, 0.01]}
)";

constexpr const char* kHarmonicAnalysis =
    R"(analysis: harmonic         # the steady vibration over a range of frequencies, see docs/harmonic.md
)";

constexpr const char* kVibration = R"(
clamps:                    # none for a free body
  - surface: x0            # a box has x0, x1, y0, y1, z0, z1

terms:
  - type: point_load
    nearest: [1, 0.025, 0.02]
    force: [0, 0, 1]       # N, the amplitude; with 1 N velocities are mobilities
    factor: {type: harmonic}   # loads without this factor are steady

harmonic:
  from: 5 Hz
  to: 200 Hz
  losses:                  # or {factor: 0.01}, {quality: 100}; or damping_ratio: 0.01 for all modes
    wood: {young: [0.007, 0.02, 0.02], shear: [0.016, 0.016, 0.016]}

output:                    # response.csv; draw it with tools/draw/draw response
  probes:
    tip: {at: [1, 0.025, 0.01], fields: [velocity]}   # also displacement, acceleration, nodal_strain, nodal_stress
)";

constexpr const char* kComparison = R"(# Which integrator reaches which error in which time?
# Run it with `orthodyn compare {file}`; its report is an HTML page.
title: What is compared
description: What is compared and why, in a sentence or two.

scenes:
  - scene.yaml             # or {file: scene.yaml, label: a name, set: {mesh.cells: [20, 2, 1]}}

integrators: [all]         # or names, or {type: cvode_bdf, max_order: 2}; see orthodyn list integrators

tolerances: [1e-2, 1e-3, 1e-4]   # of the adaptive methods
steps: [0.02 s, 0.01 s]          # of the fixed-step methods

repeats: 3                 # timed integrations of each point
samples: 100               # times at which errors are measured
limits: {seconds: 60}      # of each integration
)";

constexpr const char* kSweep = R"(# How do results depend on inputs?
# Run it with `orthodyn sweep {file}`; its report is an HTML page.
title: What is varied
description: What is varied and why, in a sentence or two.

scene: scene.yaml          # or {file: scene.yaml, set: {mesh.cells: [20, 2, 1]}}

vary:                      # keys of the scene by their paths; every combination is a point
  materials.wood.young.0: {from: 5, to: 20, count: 4, unit: GPa, name: E1}   # scale: log for equal ratios
  materials.wood.nu12: [0.3, 0.44]
  # mesh: {coarse: {mesh.cells: [40, 4, 2]}, fine: {mesh.cells: [80, 8, 4]}}   # named sets of keys
# combine: latin_hypercube # or zip; with samples: 50, seed: 1 and ranges without count

quantities:                # see orthodyn list sweep
  sag: {quantity: tip.displacement.z, take: min, unit: mm}   # closed_form: a formula of the varied values, SI units
  settling: {quantity: tip.displacement.z, settled_within: 0.05}
  frequency: {mode: 1}
  steps: {cost: steps}

frames: {color: displacement}   # a picture of each point at the end; leave it out for none
limits: {seconds: 60}      # of each point
)";

constexpr const char* kFit = R"(# Which stiffnesses explain what was measured?
# Run it with `orthodyn fit {file}`; its report is an HTML page.
title: What is fitted
description: What was measured, how, and on which body.

experiments:               # one or several, by name
  plate:
    scene: scene.yaml      # or {file: scene.yaml, set: {mesh.cells: [20, 2, 1]}}
    measured:              # each value with its standard deviation: deviation, or relative (0.01 for 1 %)
      - {frequencies: [16.2 Hz, null, 101 Hz], relative: 0.01}      # the lowest; null: not measured
      # - {quantity: tip.displacement.z, value: -4.1 mm, deviation: 0.1 mm}                     # static
      # - {quantity: tip.displacement.z, at: 0.2 s, value: -4.1 mm, deviation: 0.1 mm}          # motion
      # - {quantity: tip.displacement.z, table: tip.csv, column: "z [mm]", deviation: 0.1 mm}   # over time

parameters:                # numbers of the scene by their paths; see orthodyn list fit
  E1: materials.wood.young.0
  G12: {path: materials.wood.g12, start: 0.6 GPa}   # also: lower, upper, prior: {value, deviation}

# candidates:              # what to measure next? values are not needed
#   torsion: {scene: scene.yaml, measured: [{mode: 3, deviation: 1 Hz}]}
)";

constexpr const char* kStability = R"(# Which integrators solve which scenes reliably?
# Run it with `orthodyn stability {file}`; its report is an HTML page.
title: What is tried
description: What is tried and why, in a sentence or two.

cases:                     # scenes with an `expect` list, see orthodyn list expect
  - scene.yaml             # of `orthodyn init scene`
  # - {file: scene.yaml, label: fine, set: {mesh.cells: [40, 4, 4]}}
integrators: [cvode_bdf, ida_bdf, tr_bdf2, generalized_alpha, auto]   # or [all], or {type: cvode_bdf, max_order: 2}
variants:                  # changes of the scene; every case is run with each
  exact: {}
  warped: {elasticity.corotation: warped}
limits: {seconds: 20}      # of each trial
)";

const std::map<std::string, std::string>& starts() {
  static const std::string head = kSceneHead, body = kBody;
  static const std::map<std::string, std::string> all = {{"scene", head + body + kMotion},
                                                         {"static", head + kAnalysis + body + kRest},
                                                         {"harmonic", head + kHarmonicAnalysis + body + kVibration},
                                                         {"comparison", kComparison},
                                                         {"sweep", kSweep},
                                                         {"fit", kFit},
                                                         {"stability", kStability}};
  return all;
}

std::string with_file_name(std::string text, const std::string& file) {
  for (std::size_t at = 0; (at = text.find("{file}", at)) != std::string::npos; at += file.size())
    text.replace(at, 6, file);
  return text;
}

std::string modeline(const std::string& kind) {
  const fs::path schema = schema_file(kind == "static" || kind == "harmonic" ? "scene" : kind);
  return fs::exists(schema) ? fmt::format("# yaml-language-server: $schema={}\n", schema.string()) : "";
}

// The template with mesh, materials, regions, clamps and loads of an Abaqus file.
std::string from_deck(const std::string& kind, const std::string& deck, const std::string& units,
                      const fs::path& scene) {
  if (kind != "scene" && kind != "static")
    throw ConfigError(fmt::format("--from: makes a scene or static file, not a {} file", kind));
  if (units != "SI" && units != "mm_t_s")
    throw ConfigError(fmt::format("--units: expected SI or mm_t_s, found '{}'", units));
  if (fs::path(deck).extension() != ".inp")
    throw ConfigError(deck,
                      "--from: expected an Abaqus file (.inp); for other meshes set mesh: {type: file} in the scene");
  const std::string file = fs::proximate(fs::absolute(deck), fs::absolute(scene).parent_path()).string();
  const bool is_static = kind == "static";
  const AbaqusScene made =
      scene_of_abaqus(deck, file, {is_static, units == "mm_t_s" ? FileUnits::mm_t_s : FileUnits::si});
  for (const std::string& what : made.left_out) fmt::print(stderr, "left out: {}\n", what);
  return kSceneHead + std::string(is_static ? kAnalysis : "") + "\n" + made.text +
         (is_static ? "" : "\ntime: {end: 1}             # s\n");
}

int init(const InitArguments& arguments) {
  const std::string& kind = arguments.kind;
  const auto start = starts().find(kind);
  if (start == starts().end()) {
    std::vector<std::string> names;
    for (const auto& [name, text] : starts()) names.push_back(name);
    throw ConfigError(fmt::format("there is no template for '{}'; known: {}", kind, join(names)));
  }
  const fs::path path = arguments.file.value_or(kind + ".yaml");
  if (is_there(path)) throw ConfigError(path.string(), "already exists; choose another name");
  if (arguments.units && !arguments.from) throw ConfigError("--units: only allowed with --from DECK.inp");
  const std::string text =
      arguments.from ? from_deck(kind, *arguments.from, arguments.units.value_or("SI"), path) : start->second;
  write_file(path, {modeline(kind), with_file_name(text, path.string())});
  fmt::print("{}\n", path.string());
  return 0;
}

void declare(InitArguments& arguments, CommandOptions& options) {
  options.value("kind", arguments.kind, "Kind of file: scene, static, harmonic, comparison, sweep, fit or stability.")
      .required();
  options.value("file", arguments.file, "Name of the file; default KIND.yaml.").type("FILE.yaml");
  options
      .value("--from", arguments.from,
             "Take mesh, materials, sections, orientations, boundary conditions and loads from an Abaqus file. "
             "Keywords that are not supported are listed.")
      .type("DECK.inp");
  options.value("--units", arguments.units, "Units of the Abaqus file: SI (default) or mm_t_s (mm, t, s, N, MPa).")
      .type("UNITS");
}

const CommandRegistration init_command(
    {.order = 110, .name = "init", .sentence = "Write a commented input file to start from.", .examples = R"(
  orthodyn init scene my.yaml
  orthodyn init scene part.yaml --from part.inp
  orthodyn init static part.yaml --from part.inp --units mm_t_s
  orthodyn init sweep
  orthodyn init fit)"},
    declare, init);

}  // namespace

}  // namespace orthodyn
