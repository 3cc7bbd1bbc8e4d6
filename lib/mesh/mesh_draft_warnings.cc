#include "lib/mesh/mesh_draft_warnings.h"

#include <cmath>
#include <map>

#include "lib/core/spelling.h"
#include "lib/mesh/cell_volume.h"
#include "lib/mesh/node_numbers.h"
#include "lib/mesh/quadratic.h"

namespace orthodyn {
namespace {

double volume_of(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) sum += cell_volume(mesh, c);
  return sum;
}

}  // namespace

std::string inverted_warning(const MeshDraft& draft, const std::vector<std::size_t>& inverted) {
  const std::size_t all = draft.cells.size();
  if (inverted.empty()) return "";
  if (inverted.size() == all && all > 1)
    return fmt::format("{}: all {} elements list their nodes in inverted order; they were reoriented",
                       draft.files.front(), all);
  const FileCell& first = draft.cells[inverted.front()];
  return fmt::format(
      "{}: {} of {} elements list their nodes in inverted order, the first is element {}; they were reoriented",
      draft.where(first.place), inverted.size(), all, first.tag);
}

std::string volume_warning(const MeshDraft& draft, const Mesh& mesh) {
  constexpr double kTolerance = 1e-3;
  const NodeNumbers number(draft.nodes);
  const auto position = [&](std::int64_t tag) -> const Vec3& {
    return draft.nodes[static_cast<std::size_t>(number(tag))].x;
  };
  double before = 0;
  for (const FileCell& cell : draft.cells) before += std::abs(volume_of(cell, position));
  const double after = volume_of(mesh);
  if (!(std::abs(after - before) > kTolerance * before)) return "";
  return fmt::format(
      "{}: the elements have a volume of {:.6g} by their shape functions, the tetrahedra that replace them {:.6g} "
      "({:+.2g} %): faces that are curved across a diagonal are approximated; refine the mesh, or use tetrahedra, to "
      "reduce the difference",
      draft.files.front(), before, after, 100 * (after / before - 1));
}

std::string split_warning(const MeshDraft& draft, std::size_t tets) {
  std::map<CellKind, std::size_t> counts;
  for (const FileCell& cell : draft.cells)
    if (cell.kind != CellKind::tet) ++counts[cell.kind];
  if (counts.empty()) return "";
  std::vector<std::string> kinds;
  std::size_t others = draft.cells.size();  // cells that are tets in the file
  for (auto it = counts.rbegin(); it != counts.rend(); ++it) {
    kinds.push_back(fmt::format("{} {}", it->second, name_of(it->first, it->second)));
    others -= it->second;
  }
  const std::string last = kinds.back();
  kinds.pop_back();
  return fmt::format("{}: {}{}{}{} split into {} {}tetrahedra", draft.files.front(), join(kinds),
                     kinds.empty() ? "" : " and ", last, draft.cells.size() - others == 1 ? " is" : " are",
                     tets - others, draft.cells.front().is_quadratic() ? "quadratic " : "");
}

}  // namespace orthodyn
