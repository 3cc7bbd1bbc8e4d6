#include "lib/mesh/stack.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "lib/core/errors.h"
#include "lib/mesh/element_of_shape.h"

namespace orthodyn {

namespace {

constexpr double kSameHeight = 0.02;  // largest difference of heights in a level

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// The corners at the bottom or top of a cell, in the order of the cell.
std::span<const int> bottom_of(const Cells& cells, int cell) {
  const auto corners = cells.corners(at(cell));
  return corners.first(corners.size() / 2);
}
std::span<const int> top_of(const Cells& cells, int cell) {
  const auto corners = cells.corners(at(cell));
  return corners.last(corners.size() / 2);
}

Vec3 centre(const Mesh& mesh, std::span<const int> nodes) {
  Vec3 sum = Vec3::Zero();
  for (const int node : nodes) sum += mesh.node(node);
  return sum / static_cast<double>(nodes.size());
}

double height(const Mesh& mesh, int cell) {
  return (centre(mesh, top_of(mesh.cells, cell)) - centre(mesh, bottom_of(mesh.cells, cell))).norm();
}

// Natural coordinates of an element's nodes after a turn: with the axis `axis` as the third one, reversed or not.
// Turns keep the orientation.
Eigen::Matrix3Xd turned_hexahedron(const Eigen::Matrix3Xd& nodes, int axis, bool reversed) {
  Eigen::Matrix3Xd old(3, nodes.cols());
  old.row(axis) = reversed ? Eigen::RowVectorXd(-nodes.row(2)) : Eigen::RowVectorXd(nodes.row(2));
  old.row((axis + 1) % 3) = nodes.row(reversed ? 1 : 0);
  old.row((axis + 2) % 3) = nodes.row(reversed ? 0 : 1);
  return old;
}
Eigen::Matrix3Xd turned_wedge(const Eigen::Matrix3Xd& nodes, bool reversed) {
  if (!reversed) return nodes;
  Eigen::Matrix3Xd old(3, nodes.cols());
  old << nodes.row(1), nodes.row(0), -nodes.row(2);
  return old;
}

// Turns one cell; returns false if none of its axes is near the direction.
template <class E>
bool turn(Mesh& mesh, int cell, const Vec3& direction) {
  const bool is_wedge = topology(E::kShape).corners == 6;
  const ElementNodes<E::kNodes> X = positions<E>(mesh, at(cell));
  const Mat3 J = E::jacobian(differences<E::kNodes>(X), E::nodes().rowwise().mean());
  int axis = 2;
  double cosine = 0;
  for (int a = is_wedge ? 2 : 0; a < 3; ++a)
    if (const double c = J.col(a).normalized().dot(direction); std::abs(c) > std::abs(cosine)) axis = a, cosine = c;
  if (std::abs(cosine) < kAlongStack) return false;
  const Eigen::Matrix3Xd nodes = E::nodes();
  const Eigen::Matrix3Xd old = is_wedge ? turned_wedge(nodes, cosine < 0) : turned_hexahedron(nodes, axis, cosine < 0);
  const std::span<int> own = mesh.cells.nodes_of(at(cell));
  const std::vector<int> before(own.begin(), own.end());
  for (Eigen::Index a = 0; a < nodes.cols(); ++a) {
    Eigen::Index from;
    (nodes.colwise() - Vec3(old.col(a))).colwise().squaredNorm().minCoeff(&from);
    own[static_cast<std::size_t>(a)] = before[static_cast<std::size_t>(from)];
  }
  return true;
}

void turn_along(Mesh& mesh, int cell, const Vec3& direction) {
  bool is_layered_shape = false, is_turned = false;
  with_element(mesh.cells.shape(at(cell)), [&]<class E>() {
    if constexpr (HasIntegrationRules<E> && E::kDegree == 2) {
      is_layered_shape = true;
      is_turned = turn<E>(mesh, cell, direction);
    }
  });
  const std::string& region = mesh.region_names[at(mesh.region_of[at(cell)])];
  if (!is_layered_shape)
    throw ConfigError("mesh", fmt::format("region '{}' has {}; a layup needs quadratic hexahedra or wedges. In a box, "
                                          "write `elements: hexahedra` without `order: 1` or `split`; for a file of "
                                          "linear ones, `order: 2`",
                                          region, topology(mesh.cells.shape(at(cell))).plural));
  if (!is_turned)
    throw ConfigError("mesh",
                      fmt::format("region '{}': no axis of cell {} is within about 45 degrees of axis 3 of the region, "
                                  "the stacking direction; set `axes` so that axis 3 goes through the thickness",
                                  region, cell));
}

FaceCorners sorted(std::span<const int> corners) {
  FaceCorners face(corners);
  face.sort();
  return face;
}

// Columns of cells from bottom to top.
std::vector<std::vector<int>> columns(const Mesh& mesh, const std::vector<int>& cells) {
  std::map<FaceCorners, int> by_bottom, by_top;
  for (const int cell : cells) {
    by_bottom[sorted(bottom_of(mesh.cells, cell))] = cell;
    by_top[sorted(top_of(mesh.cells, cell))] = cell;
  }
  std::vector<std::vector<int>> out;
  for (const int cell : cells) {
    if (by_top.contains(sorted(bottom_of(mesh.cells, cell)))) continue;
    std::vector<int> column{cell};
    for (auto next = by_bottom.find(sorted(top_of(mesh.cells, cell))); next != by_bottom.end();
         next = by_bottom.find(sorted(top_of(mesh.cells, column.back()))))
      column.push_back(next->second);
    out.push_back(std::move(column));
  }
  return out;
}

}  // namespace

Stack make_stack(Mesh& mesh, int region, const std::function<Vec3(int cell)>& direction) {
  std::vector<int> cells;
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell)
    if (mesh.region_of[at(cell)] == region) cells.push_back(cell);
  for (const int cell : cells) turn_along(mesh, cell, direction(cell));

  const auto refuse = [&](const std::string& reason) {
    throw ConfigError("mesh",
                      fmt::format("region '{}' cannot have a layup: {}", mesh.region_names[at(region)], reason));
  };
  const auto all = columns(mesh, cells);
  std::size_t in_columns = 0;
  for (const auto& column : all) in_columns += column.size();
  if (in_columns != cells.size())
    refuse("its cells form closed rings along axis 3 of the region, so no ply has a bottom");

  // Levels by the number of cells in a column and the place in it.
  struct Sums {
    std::vector<int> cells;
    double bottom = 0, top = 0, lowest = 1, highest = 0;  // `lowest` and `highest`: of the tops
  };
  std::map<std::pair<std::size_t, std::size_t>, Sums> by_place;
  double lowest = std::numeric_limits<double>::infinity(), highest = 0;
  for (const auto& column : all) {
    double total = 0, below = 0;
    for (const int cell : column) total += height(mesh, cell);
    lowest = std::min(lowest, total);
    highest = std::max(highest, total);
    for (std::size_t i = 0; i < column.size(); ++i) {
      Sums& level = by_place[{column.size(), i}];
      const double bottom = below / total;
      below += height(mesh, column[i]);
      const double top = i + 1 == column.size() ? 1 : below / total;
      level.cells.push_back(column[i]);
      level.bottom += bottom;
      level.top += top;
      level.lowest = std::min(level.lowest, top);
      level.highest = std::max(level.highest, top);
    }
  }
  Stack stack{{}, lowest, highest};
  for (auto& [place, level] : by_place) {
    if (level.highest - level.lowest > kSameHeight)
      refuse(
          fmt::format("its columns divide their height differently (cell {} from the bottom ends between {:.3g} and "
                      "{:.3g} of the height); use one cell through the thickness, or the same proportions everywhere",
                      place.second + 1, level.lowest, level.highest));
    const auto n = static_cast<double>(level.cells.size());
    std::sort(level.cells.begin(), level.cells.end());
    stack.levels.push_back({std::move(level.cells), level.bottom / n, level.top / n});
  }
  // Neighbours in a column share a height.
  for (std::size_t i = 1; i < stack.levels.size(); ++i)
    if (stack.levels[i].bottom > 0) stack.levels[i].bottom = stack.levels[i - 1].top;
  return stack;
}

}  // namespace orthodyn
