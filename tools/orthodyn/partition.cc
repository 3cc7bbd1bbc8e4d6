// `orthodyn partition`: what ranks would have of a scene's mesh, and tell each other, for any number of them. What
// springs between nodes add to it is not counted.
#include "lib/mesh/partition.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <vector>

#include "lib/core/errors.h"
#include "lib/linear/mpi_world.h"
#include "lib/scene/mesh_materials.h"
#include "lib/scene/scene.h"
#include "lib/simulation/run/scene_file.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/whole_numbers.h"

namespace orthodyn {

namespace {

constexpr int kMostParts = 100'000;

struct PartitionArguments {
  std::string scene, parts = "2,4,8,16,32,64,128,256,512,1024";
  std::vector<std::string> set;
  // Of the model of a step's time: s of one rank, and what it does meanwhile.
  double step = 0, exchanges = 0, reductions = 0;
  double latency = 2e-6, bandwidth = 10e9;  // s, B/s
};

struct Division {
  int parts = 1;
  double most_cells = 0, mean_cells = 0;
  double most_copies = 0, most_bytes = 0, all_bytes = 0;  // bytes that a part sends and receives in an exchange
  double most_neighbours = 0, mean_neighbours = 0;

  double imbalance() const { return most_cells / mean_cells; }
};

Division division_of(const TetMesh& mesh, const CellGraph& graph, int parts) {
  constexpr double kBytes = 3 * sizeof(double);
  Division division{.parts = parts, .mean_cells = static_cast<double>(mesh.tets.size()) / parts};
  for (const PartFigures& part : figures_of_parts(mesh, parts_of_cells(graph, parts), parts)) {
    const double bytes = kBytes * static_cast<double>(part.copies + part.copied);
    division.most_cells = std::max(division.most_cells, static_cast<double>(part.cells));
    division.most_copies = std::max(division.most_copies, static_cast<double>(part.copies));
    division.most_bytes = std::max(division.most_bytes, bytes);
    division.all_bytes += bytes / 2;  // each is sent once and received once
    division.most_neighbours = std::max(division.most_neighbours, static_cast<double>(part.neighbours));
    division.mean_neighbours += static_cast<double>(part.neighbours) / parts;
  }
  return division;
}

// s. Each part computes its share; an exchange is a message to and from each neighbour, a sum over all ranks goes up
// and down a binary tree.
double seconds_of_step(const Division& division, const PartitionArguments& arguments) {
  const double compute = arguments.step / division.parts * division.imbalance();
  const double exchange = division.most_neighbours * arguments.latency + division.most_bytes / arguments.bandwidth;
  const int levels = std::bit_width(static_cast<unsigned>(division.parts - 1));
  return compute + arguments.exchanges * exchange + arguments.reductions * 2 * levels * arguments.latency;
}

std::string shown_step(const Division& division, const PartitionArguments& arguments) {
  const double seconds = seconds_of_step(division, arguments);
  return fmt::format(" {:10.3g} s {:8.0f} %", seconds, 100 * arguments.step / division.parts / seconds);
}

void require_positive(const std::string& option, double value, bool or_zero) {
  if (!(value > 0 || (or_zero && value == 0)) || !std::isfinite(value))
    throw ConfigError(fmt::format("{}: must be {}, found {:g}", option, or_zero ? "0 or more" : "positive", value));
}

int partition(const PartitionArguments& arguments) {
  require_positive("--step", arguments.step, arguments.exchanges == 0 && arguments.reductions == 0);
  require_positive("--exchanges", arguments.exchanges, true);
  require_positive("--reductions", arguments.reductions, true);
  if (arguments.step > 0 && arguments.exchanges == 0 && arguments.reductions == 0)
    throw ConfigError(
        "--step: give --exchanges or --reductions as well; without them the model knows of no "
        "communication");
  require_positive("--latency", arguments.latency, true);
  require_positive("--bandwidth", arguments.bandwidth, false);
  const std::vector<int> numbers = whole_numbers("--parts", arguments.parts, 2, kMostParts);
  parts_of_cells({{0, 0}, {}}, 2);  // before the mesh is read: it throws where this build cannot
  const Scene scene = read_scene(read_scene_file(arguments.scene, {.set = arguments.set}));
  const TetMesh mesh = load_mesh(scene).mesh;
  fmt::print("{}: {} nodes, {} elements of order {}\n", arguments.scene, mesh.nodes.size(), mesh.tets.size(),
             mesh.order());
  const CellGraph graph = cell_graph(sorted_faces(mesh), mesh.tets.size());
  const bool with_time = arguments.step > 0;
  fmt::print(
      "of the largest part: elements, also as a multiple of the mean, neighbours (and their mean), copies of others'\n"
      "nodes, bytes of a vector that it sends and receives; and what all exchange\n"
      "{:>6} {:>9} {:>8} {:>11} {:>7} {:>8} {:>12} {:>11}{}\n",
      "parts", "elements", "of mean", "neighbours", "(mean)", "copies", "exchange", "all",
      with_time ? fmt::format(" {:>12} {:>10}", "step", "efficiency") : "");
  for (const int parts : numbers) {
    if (static_cast<std::size_t>(parts) > mesh.tets.size()) {
      fmt::print("{:6}  more than there are elements\n", parts);
      continue;
    }
    const Division division = division_of(mesh, graph, parts);
    fmt::print("{:6} {:9.0f} {:8.3f} {:11.0f} {:7.1f} {:8.0f} {:9.4g} kB {:8.4g} MB{}\n", parts, division.most_cells,
               division.imbalance(), division.most_neighbours, division.mean_neighbours, division.most_copies,
               1e-3 * division.most_bytes, 1e-6 * division.all_bytes, with_time ? shown_step(division, arguments) : "");
    std::fflush(stdout);
  }
  return 0;
}

void declare(PartitionArguments& arguments, CommandOptions& options) {
  options.value("scene", arguments.scene, "A scene in YAML.").required().type("SCENE.yaml");
  options.repeated("--set", arguments.set, "Change a value by its path.").type("PATH=VALUE");
  options.value("--parts", arguments.parts, "Numbers of parts, that is of ranks.").type("N,N,...").show_default();
  options.value("--step", arguments.step, "Seconds of a step by one rank, for a model of that by more.");
  options.value("--exchanges", arguments.exchanges, "Exchanges of a vector with neighbours in a step.").needs("--step");
  options.value("--reductions", arguments.reductions, "Sums over all ranks in a step.").needs("--step");
  options.value("--latency", arguments.latency, "Seconds that a message takes at least.")
      .show_default()
      .needs("--step");
  options.value("--bandwidth", arguments.bandwidth, "Bytes a second between two ranks.").show_default().needs("--step");
}

const CommandRegistration partition_command(
    {.order = 25,
     .name = "partition",
     .sentence = "Divide a scene's mesh for mpirun: elements of a part, neighbours, what they exchange, and a model of "
                 "the time of a step.",
     .examples = R"(
  orthodyn partition configs/scenes/cantilever.yaml --parts 2,4
  orthodyn partition mine.yaml --parts 16,64 --step 9.1 --exchanges 400 --reductions 500)"},
    declare, partition);

}  // namespace

}  // namespace orthodyn
