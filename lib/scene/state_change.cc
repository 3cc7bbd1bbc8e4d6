#include "lib/scene/state_change.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "lib/config/csv_table.h"

namespace orthodyn {

namespace {

// The value of each node of the mesh.
Vector read_nodal(const FilePath& file, const std::string& quantity, Eigen::Index num_nodes) {
  constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
  const CsvTable table = read_csv(file, {"node", quantity});
  Vector values = Vector::Constant(num_nodes, kMissing);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const int node = table.index(row, "node");
    if (node >= num_nodes)
      throw ConfigError(table.where(row),
                        fmt::format("there is no node {}; the mesh has the nodes 0 to {}", node, num_nodes - 1));
    if (!std::isnan(values[node])) throw ConfigError(table.where(row), fmt::format("node {} is given twice", node));
    values[node] = table.at(row, table.column(quantity));
  }
  for (Eigen::Index i = 0; i < num_nodes; ++i)
    if (std::isnan(values[i]))
      throw ConfigError(file.path, fmt::format("has no value for node {} of {}", i, num_nodes));
  return values;
}

// The positions of all points, one column each, element by element.
Eigen::Matrix3Xd places_of(const ElementType& type, const ElementMesh& mesh, const std::vector<int>& cells) {
  const Eigen::Index points = type.num_points();
  Eigen::Matrix3Xd all(3, static_cast<Eigen::Index>(cells.size()) * points);
  for (std::size_t k = 0; k < cells.size(); ++k)
    all.middleCols(static_cast<Eigen::Index>(k) * points, points) =
        type.points(mesh.positions(static_cast<std::size_t>(cells[k])));
  return all;
}

// Nodal values interpolated by the shape functions, which ElementType::points() applies to positions, within the range
// of the element's nodes: quadratic functions would leave it where the values jump.
Vector interpolated(const Vector& nodal, const ElementType& type, const ElementMesh& mesh,
                    const std::vector<int>& cells) {
  const Eigen::Index points = type.num_points();
  Vector all(static_cast<Eigen::Index>(cells.size()) * points);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const auto nodes = mesh.cells[static_cast<std::size_t>(cells[k])];
    ElementType::Nodes values = ElementType::Nodes::Zero(3, static_cast<Eigen::Index>(nodes.size()));
    for (std::size_t a = 0; a < nodes.size(); ++a) values(0, static_cast<Eigen::Index>(a)) = nodal[nodes[a]];
    all.segment(static_cast<Eigen::Index>(k) * points, points) =
        type.points(values).row(0).cwiseMax(values.row(0).minCoeff()).cwiseMin(values.row(0).maxCoeff());
  }
  return all;
}

}  // namespace

void StateChange::check(const Config& config) const {
  const int given = int{change.has_value()} + int{formula.has_value()} + int{file.has_value()};
  if (given != 1)
    config.fail(fmt::format("give one of {}, formula and file; {}", quantity,
                            given == 0 ? "none is given" : "the section has several"));
  if (formula && !factor->constant())
    config.at("factor").fail("has no effect beside 'formula', which may contain the time t; remove it");
  if (!formula && !kinks.empty())
    config.at("kinks").fail("are those of 'formula', which is not given; a factor has kinks of its own");
}

const Spec<StateChange>& StateChange::spec() {
  static const auto s =
      Spec<StateChange>()
          .key("change", &StateChange::change,
               "Change from the stress-free state, in per cent of moisture content or in K: a number, or a formula of "
               "x, y, z.")
          .key("factor", &StateChange::factor, "Factor of `change` or `file` in time.",
               {.fallback = "{type: constant}"})
          .key("formula", &StateChange::formula, "Instead of `change` and `factor`: a formula of t, x, y, z.")
          .key("kinks", &StateChange::kinks, "Times at which `formula` is not smooth; integrators restart there.",
               {.unit = "s"})
          .key("file", &StateChange::file,
               "Instead of `change`: a CSV file with the columns node (from 0) and change, for all nodes of the mesh.")
          .check([](const StateChange& change, const Config& config) { change.check(config); });
  return s;
}

std::unique_ptr<PointValues> StateChange::at_points(const ElementType& type, const ElementMesh& mesh,
                                                    const std::vector<int>& cells, const std::vector<int>& of_all_ranks,
                                                    double start, double end) const {
  const int points = type.num_points();
  const auto resolved = factor->over(start, end);
  const auto in_time = resolved ? resolved : factor;
  if (file)
    return scaled_values(
        interpolated(read_nodal(*file, quantity, static_cast<Eigen::Index>(mesh.nodes.size())), type, mesh, cells),
        in_time, points);
  Eigen::Matrix3Xd places = places_of(type, mesh, cells);
  if (formula) {
    const std::vector<int> some{of_all_ranks.front(), of_all_ranks[of_all_ranks.size() / 2], of_all_ranks.back()};
    return formula_values(*formula, std::move(places), places_of(type, mesh, some), start, end, kinks, points);
  }
  Vector values(places.cols());
  for (Eigen::Index i = 0; i < places.cols(); ++i) values[i] = change->at(places.col(i));
  return scaled_values(std::move(values), in_time, points);
}

}  // namespace orthodyn
