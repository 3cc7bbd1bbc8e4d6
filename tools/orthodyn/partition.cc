// `orthodyn partition`: predicts load balance and communication of a scene's mesh on any number of MPI ranks.
// Communication of springs between nodes is not counted.
#include "lib/mesh/partition.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <vector>

#include "lib/core/errors.h"
#include "lib/linear/mpi_world.h"
#include "lib/scene/mesh_materials.h"
#include "lib/scene/scene.h"
#include "lib/simulation/run/scene_file.h"
#include "tools/orthodyn/command.h"

namespace orthodyn {

namespace {

constexpr int kMostParts = 100'000;

struct PartitionArguments {
  std::string scene, parts = "2,4,8,16,32,64,128,256,512,1024";
  std::vector<std::string> set;
  double step = 0, exchanges = 0, reductions = 0;  // time of a step on one rank, s; numbers per step
  double latency = 2e-6, bandwidth = 10e9;         // s, B/s
};

// Largest and mean loads over the parts of a partition.
struct Division {
  int parts = 1;
  double most_cells = 0, mean_cells = 0;
  double most_copies = 0;
  double most_bytes = 0, all_bytes = 0;  // in one exchange: sent and received by a part; sent by all parts
  double most_neighbours = 0, mean_neighbours = 0;

  double imbalance() const { return most_cells / mean_cells; }
};

Division division_of(const Mesh& mesh, const CellGraph& graph, int parts) {
  constexpr double kBytes = 3 * sizeof(double);
  Division division{.parts = parts, .mean_cells = static_cast<double>(mesh.cells.size()) / parts};
  for (const PartSize& part : part_sizes(mesh, parts_of_cells(graph, parts), parts)) {
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

// Predicted time (s) of a step: the largest part's computation, exchanges with each neighbour, and global sums over a
// binary tree (up and down).
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

// Reads "2,4,8". Throws ConfigError that names `option` unless all numbers are integers in [least, most].
std::vector<int> parse_integers(const std::string& option, const std::string& text, int least, int most) {
  std::vector<int> numbers;
  std::istringstream words(text + ",");
  for (std::string word; std::getline(words, word, ',');) {
    int number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size() || number < least || number > most)
      throw ConfigError(
          fmt::format("{}: expected integers from {} to {}, such as 2,4,8; found '{}'", option, least, most, text));
    numbers.push_back(number);
  }
  return numbers;
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
    throw ConfigError("--step: needs --exchanges or --reductions as well; without them communication takes no time");
  require_positive("--latency", arguments.latency, true);
  require_positive("--bandwidth", arguments.bandwidth, false);
  const std::vector<int> numbers = parse_integers("--parts", arguments.parts, 2, kMostParts);
  parts_of_cells({{0, 0}, {}}, 2);  // throws here, before the mesh is read, if PETSc is not available
  const Scene scene = read_scene(read_scene_file(arguments.scene, {.set = arguments.set}));
  const Mesh mesh = load_mesh(scene).mesh;
  fmt::print("{}: {} nodes, {} elements of order {}\n", arguments.scene, mesh.nodes.size(), mesh.cells.size(),
             mesh.order());
  const CellGraph graph = cell_graph(sorted_faces(mesh), mesh.cells.size());
  const bool with_time = arguments.step > 0;
  fmt::print(
      "per part, the largest: elements (and their ratio to the mean), neighbours (and their mean), nodes copied from "
      "other\n"
      "parts, data sent and received per exchange of a vector; all: data sent by all parts together\n"
      "{:>6} {:>9} {:>8} {:>11} {:>7} {:>8} {:>12} {:>11}{}\n",
      "parts", "elements", "of mean", "neighbours", "(mean)", "copies", "exchange", "all",
      with_time ? fmt::format(" {:>12} {:>10}", "step", "efficiency") : "");
  for (const int parts : numbers) {
    if (static_cast<std::size_t>(parts) > mesh.cells.size()) {
      fmt::print("{:6}  more parts than elements\n", parts);
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
  options.repeated("--set", arguments.set, "Change a value of the scene by its path.").type("PATH=VALUE");
  options.value("--parts", arguments.parts, "Numbers of parts (ranks) to compare.").type("N,N,...").show_default();
  options.value("--step", arguments.step,
                "Measured time of a step on one rank, in s: also predict the time on more ranks.");
  options.value("--exchanges", arguments.exchanges, "Number of vector exchanges with neighbours per step.")
      .needs("--step");
  options.value("--reductions", arguments.reductions, "Number of sums over all ranks per step.").needs("--step");
  options.value("--latency", arguments.latency, "Latency of a message, in s.").show_default().needs("--step");
  options.value("--bandwidth", arguments.bandwidth, "Bandwidth between two ranks, in bytes/s.")
      .show_default()
      .needs("--step");
}

const CommandRegistration partition_command(
    {.order = 25,
     .name = "partition",
     .sentence = "Predict how a scene's mesh divides over MPI ranks: load balance, communication, and time of a step.",
     .examples = R"(
  orthodyn partition configs/scenes/cantilever.yaml --parts 2,4
  orthodyn partition mine.yaml --parts 16,64 --step 9.1 --exchanges 400 --reductions 500)"},
    declare, partition);

}  // namespace

}  // namespace orthodyn
