// The connectivity of a mesh whose cells all have the same number of nodes.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace orthodyn {

class Cells {
 public:
  Cells() = default;

  // `nodes`: node indices, cell by cell. Precondition: their number is a multiple of nodes_per_cell.
  Cells(int nodes_per_cell, std::vector<int> nodes)
      : nodes_per_cell_(static_cast<std::size_t>(nodes_per_cell)), nodes_(std::move(nodes)) {}

  template <std::size_t kNodes>
  explicit Cells(const std::vector<std::array<int, kNodes>>& cells) : nodes_per_cell_(kNodes) {
    nodes_.reserve(kNodes * cells.size());
    for (const auto& cell : cells) nodes_.insert(nodes_.end(), cell.begin(), cell.end());
  }

  std::size_t size() const { return nodes_.size() / nodes_per_cell_; }
  int nodes_per_cell() const { return static_cast<int>(nodes_per_cell_); }

  // The nodes of one cell; valid as long as this object.
  std::span<const int> operator[](std::size_t cell) const {
    return {nodes_.data() + cell * nodes_per_cell_, nodes_per_cell_};
  }

  // The nodes of all cells, cell by cell.
  const std::vector<int>& nodes() const { return nodes_; }

 private:
  std::size_t nodes_per_cell_ = 1;
  std::vector<int> nodes_;
};

}  // namespace orthodyn
