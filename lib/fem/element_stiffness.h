// The 12x12 stiffness of a tetrahedron as 3x3 blocks, and its way into the matrix.
#pragma once

#include <array>

#include "lib/element/tangent_form.h"
#include "lib/element/tet4.h"
#include "lib/fem/block_pattern.h"

namespace orthodyn {

// block[a][b]; of a symmetric one block[0][b], b > 0, is not set.
using ElementBlocks = std::array<std::array<Mat3, 4>, 4>;

// K_ab = V g_a : H : g_b.
template <class C>
ElementBlocks element_stiffness(const TangentFormOf<C>& form, const Tet4& shape, bool symmetric);

// Where the off-diagonal blocks of an element lie in a symmetric pattern. A general pattern is
// searched at each use: it serves comparisons only, and is not worth the memory.
class ElementOffsets {
 public:
  ElementOffsets(const Tet& tet, const BlockPattern& pattern);
  int operator[](int pair) const { return offset_[static_cast<std::size_t>(pair)]; }

 private:
  std::array<int, 6> offset_;
};

void scatter(const ElementBlocks& blocks, const Tet& tet, const ElementOffsets& offsets,
             const BlockPattern& pattern, double* values);

// G G^T (6x6, 1/m^2), where G maps nodal displacements to the Voigt strain in material axes.
Mat6 strain_gram(const Tet4& shape);

}  // namespace orthodyn
