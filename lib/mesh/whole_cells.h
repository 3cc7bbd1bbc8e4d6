// Elements of a file that become cells as they are.
#pragma once

#include <functional>
#include <vector>

#include "lib/mesh/mesh_draft.h"

namespace orthodyn {

// Whether all elements of the file can stay as they are.
bool can_keep_cells(const MeshDraft& draft, FileCells cells);

// The shape of an element, and the tags of its nodes in the order of cell_shape.h. Precondition: can_keep_cells().
struct WholeCell {
  CellShape shape;
  std::vector<std::int64_t> nodes;
};
WholeCell whole_cell(const FileCell& cell);

// Exchanges the nodes of a cell so that its orientation is reversed.
void turn_cell(CellShape shape, std::span<int> nodes);

}  // namespace orthodyn
