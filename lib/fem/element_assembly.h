// Assembly of element matrices into a matrix on a BlockPattern.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "lib/fem/block_pattern.h"
#include "lib/fem/element_batches.h"
#include "lib/fem/element_stiffness.h"

namespace orthodyn {

// Offsets of the off-diagonal blocks of an element in a symmetric pattern. A general pattern has twice as many; its
// offsets are not stored here but looked up in the pattern at each use.
template <int kNodes>
class ElementOffsets {
 public:
  using Nodes = std::array<int, static_cast<std::size_t>(kNodes)>;

  ElementOffsets(const Nodes& nodes, const BlockPattern& pattern) {
    std::size_t pair = 0;
    for (std::size_t j = 0; j < kNodes; ++j)
      for (std::size_t i = j + 1; i < kNodes; ++i)
        offset_[pair++] = pattern.offset(std::max(nodes[i], nodes[j]), std::min(nodes[i], nodes[j]));
  }
  // `pair` numbers the element's node pairs (i, j) with i > j, i fastest.
  int operator[](int pair) const { return offset_[static_cast<std::size_t>(pair)]; }

 private:
  std::array<int, static_cast<std::size_t>(kNodes*(kNodes - 1) / 2)> offset_;
};

// Adds the blocks of an element with these nodes to `values`.
template <int kNodes>
[[gnu::noipa]] void scatter(const ElementBlocks<kNodes>& blocks, const typename ElementOffsets<kNodes>::Nodes& nodes,
                            const ElementOffsets<kNodes>& offsets, const BlockPattern& pattern, double* values) {
  for (std::size_t a = 0; a < kNodes; ++a)
    pattern.add(nodes[a], nodes[a], pattern.symmetric() ? 0 : pattern.offset(nodes[a], nodes[a]), blocks[a][a], values);
  int pair = 0;
  for (std::size_t j = 0; j < kNodes; ++j)
    for (std::size_t i = j + 1; i < kNodes; ++i, ++pair) {
      const int a = nodes[i], b = nodes[j];
      const Mat3& block = blocks[i][j];
      if (!pattern.symmetric()) {
        pattern.add(a, b, pattern.offset(a, b), block, values);
        pattern.add(b, a, pattern.offset(b, a), blocks[j][i], values);
      } else if (a > b) {
        pattern.add(a, b, offsets[pair], block, values);
      } else {
        pattern.add(b, a, offsets[pair], block.transpose(), values);
      }
    }
}

// Like scatter(), for one lane of a symmetric batch whose nodes are all free.
template <int kNodes>
[[gnu::noipa]] void scatter_lane(const ElementBlocks<kNodes, Batch>& blocks, int lane,
                                 const typename ElementOffsets<kNodes>::Nodes& nodes,
                                 const ElementOffsets<kNodes>& offsets, const BlockPattern& pattern, double* values) {
  constexpr int kNext = Batch::kLanes;  // stride of the entries of a block
  const auto entries = [&](std::size_t a, std::size_t b) {
    return reinterpret_cast<const double*>(&blocks[a][b]) + lane;
  };
  for (std::size_t a = 0; a < kNodes; ++a) pattern.add_free_diagonal(nodes[a], entries(a, a), kNext, 3 * kNext, values);
  int pair = 0;
  for (std::size_t j = 0; j < kNodes; ++j)
    for (std::size_t i = j + 1; i < kNodes; ++i, ++pair) {
      const bool is_below = nodes[i] > nodes[j];  // otherwise the transposed block is below the diagonal
      pattern.add_free(is_below ? nodes[j] : nodes[i], offsets[pair], entries(i, j), is_below ? kNext : 3 * kNext,
                       is_below ? 3 * kNext : kNext, values);
    }
}

// Copies the blocks of one lane of a batch.
template <int kNodes>
void take_lane(const ElementBlocks<kNodes, Batch>& blocks, bool symmetric, int lane, ElementBlocks<kNodes>& out) {
  for (std::size_t a = 0; a < kNodes; ++a)
    for (std::size_t b = 0; b < kNodes; ++b)
      if (!symmetric || b <= a)
        for (int i = 0; i < 9; ++i) out[a][b](i) = blocks[a][b](i)[lane];
}

inline namespace ORTHODYN_LANES {

// Assembles the matrices of a region's elements, one by one or in batches. Const functions may run concurrently for
// elements without a common node.
template <Element E>
class ElementAssembly {
 public:
  // Both arguments must outlive this object.
  ElementAssembly(const ElementBatches<E>& elements, const BlockPattern& pattern)
      : elements_(elements), pattern_(pattern) {
    offsets_.reserve(static_cast<std::size_t>(elements.size()));
    for (int k = 0; k < elements.size(); ++k) offsets_.emplace_back(elements.nodes(k), pattern);
  }

  bool symmetric() const { return pattern_.symmetric(); }
  std::size_t bytes() const { return offsets_.capacity() * sizeof(Offsets); }

  // Adds the matrix of element k; form_at(p) is the tangent form at its point p. add_more(blocks) may add to the blocks
  // of nodes 1, 2, ...; this function then computes those of node 0 from them.
  template <class FormAt, class AddMore>
  void add_element(int k, double* values, FormAt&& form_at, AddMore&& add_more) const {
    ElementBlocks<E::kNodes> blocks;
    for (int p = 0; p < elements_.num_points(); ++p)
      add_point_stiffness<E::kNodes>(form_at(p), elements_.point(k, p), symmetric(), p == 0, blocks);
    add_more(blocks);
    complete<E::kNodes>(symmetric(), blocks);
    add_blocks(k, blocks, values);
  }

  // Adds the matrices of a batch. `blocks` gives the blocks of nodes 1, 2, ...; this function computes those of node 0
  // from them.
  void add_batch(int b, ElementBlocks<E::kNodes, Batch>& blocks, double* values) const {
    complete<E::kNodes>(symmetric(), blocks);
    for (int l = 0; l < elements_.lanes(b); ++l) {
      const int k = b * Batch::kLanes + l;
      const auto nodes = elements_.nodes(k);
      const auto is_free = [&](int node) { return pattern_.is_free(node); };
      if (symmetric() && std::all_of(nodes.begin(), nodes.end(), is_free)) {
        scatter_lane<E::kNodes>(blocks, l, nodes, offsets_[static_cast<std::size_t>(k)], pattern_, values);
      } else {
        ElementBlocks<E::kNodes> one;
        take_lane<E::kNodes>(blocks, symmetric(), l, one);
        add_blocks(k, one, values);
      }
    }
  }

 private:
  using Offsets = ElementOffsets<E::kNodes>;

  void add_blocks(int k, const ElementBlocks<E::kNodes>& blocks, double* values) const {
    scatter<E::kNodes>(blocks, elements_.nodes(k), offsets_[static_cast<std::size_t>(k)], pattern_, values);
  }

  const ElementBatches<E>& elements_;
  const BlockPattern& pattern_;
  std::vector<Offsets> offsets_;
};

}  // namespace ORTHODYN_LANES

}  // namespace orthodyn
