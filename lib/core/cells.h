// The connectivity of a mesh: the shape and the nodes of each cell.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "lib/core/cell_shape.h"

namespace orthodyn {

class Cells {
 public:
  Cells() = default;

  // Cells of one shape. `nodes`: node indices, cell by cell. Precondition: a whole number of cells.
  Cells(CellShape shape, std::span<const int> nodes) {
    const auto per_cell = static_cast<std::size_t>(topology(shape).nodes);
    reserve(nodes.size() / per_cell, per_cell);
    for (; !nodes.empty(); nodes = nodes.subspan(per_cell)) add(shape, nodes.first(per_cell));
  }

  explicit Cells(const std::vector<std::array<int, 4>>& tets) {
    reserve(tets.size(), 4);
    for (const auto& tet : tets) add(CellShape::tet4, tet);
  }

  void reserve(std::size_t cells, std::size_t nodes_per_cell) {
    nodes_.reserve(cells * nodes_per_cell);
    start_.reserve(cells + 1);
    shapes_.reserve(cells);
  }

  void add(CellShape shape, std::span<const int> nodes) {
    nodes_.insert(nodes_.end(), nodes.begin(), nodes.end());
    start_.push_back(nodes_.size());
    shapes_.push_back(shape);
  }

  std::size_t size() const { return shapes_.size(); }
  bool empty() const { return shapes_.empty(); }

  CellShape shape(std::size_t cell) const { return shapes_[cell]; }
  const std::vector<CellShape>& shapes() const { return shapes_; }

  // The nodes of one cell, in the order of cell_shape.h; valid until a cell is added.
  std::span<const int> operator[](std::size_t cell) const {
    return {nodes_.data() + start_[cell], start_[cell + 1] - start_[cell]};
  }
  std::span<int> nodes_of(std::size_t cell) { return {nodes_.data() + start_[cell], start_[cell + 1] - start_[cell]}; }
  std::span<const int> corners(std::size_t cell) const {
    return {nodes_.data() + start_[cell], static_cast<std::size_t>(topology(shapes_[cell]).corners)};
  }

  // The nodes of all cells, cell by cell.
  const std::vector<int>& nodes() const { return nodes_; }
  std::vector<int>& nodes() { return nodes_; }

  std::size_t bytes() const {
    return nodes_.size() * sizeof(int) + start_.size() * sizeof(std::size_t) + shapes_.size() * sizeof(CellShape);
  }

  bool operator==(const Cells&) const = default;

 private:
  std::vector<int> nodes_;
  std::vector<std::size_t> start_{0};  // start of each cell in nodes_, and the end of the last
  std::vector<CellShape> shapes_;
};

}  // namespace orthodyn
