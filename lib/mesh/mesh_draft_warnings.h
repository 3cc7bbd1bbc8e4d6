// Warnings of build_mesh(); "" if there is nothing to report.
#pragma once

#include "lib/mesh/mesh_draft.h"

namespace orthodyn {

// `inverted`: the cells that were inverted, as ascending indices into draft.cells.
std::string inverted_warning(const MeshDraft& draft, const std::vector<std::size_t>& inverted);

// "beam.msh: 120 hexahedra and 30 wedges are split into 750 tetrahedra".
std::string split_warning(const MeshDraft& draft, std::size_t tets);

// Warns if the volume of the tets differs from that of the cells by more than 0.1 %.
std::string volume_warning(const MeshDraft& draft, const Mesh& mesh);

}  // namespace orthodyn
