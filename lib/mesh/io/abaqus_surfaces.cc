#include "lib/mesh/io/abaqus_surfaces.h"

#include <algorithm>
#include <utility>

#include "lib/mesh/io/text_tokens.h"
#include "lib/mesh/split_cells.h"

namespace orthodyn {
namespace {

FileFace face_of_cell(const MeshDraft& draft, const FileCell& cell, const AbaqusFace& face,
                      const std::string& surface) {
  const std::vector<CornerIndices>& faces = faces_of(cell.kind);
  if (face.side >= faces.size())
    draft.fail(face.elements.place, "surface {}: S{} of element {}; a {} has S1 to S{}", TextTokens::quoted(surface),
               face.side + 1, cell.tag, name_of(cell.kind), faces.size());
  const CornerIndices& places = faces[face.side];
  FileFace out{.tag = cell.tag, .sides = places.size(), .place = face.elements.place};
  for (std::size_t k = 0; k < places.size(); ++k) out.nodes[k] = cell.nodes[places[k]];
  return out;
}

// SPOS is the side of a shell that its normal points to, SNEG the opposite side.
void add_sides_of_shells(const AbaqusFile& file, AbaqusLookup& lookup, const AbaqusFace& side,
                         const std::string& surface, std::vector<FileFace>& faces) {
  const std::size_t found = lookup.each_face(side.elements, [&](std::size_t f) {
    faces.push_back(file.faces[f]);
    if (side.side == AbaqusFace::kNegative) {
      const auto corners = faces.back().corners();
      std::reverse(corners.begin() + 1, corners.end());
    }
  });
  if (found == 0)
    file.draft.fail(side.elements.place,
                    "surface {}: SPOS and SNEG are sides of shells and membranes, and there is no such element; solid "
                    "elements have S1 to S6",
                    TextTokens::quoted(surface));
}

// A *DLOAD may list elements of other kinds, whose loads have the same names; faces that a cell lacks are skipped.
void add_loaded_faces(AbaqusFile& file, AbaqusLookup& lookup, const AbaqusSurface& surface) {
  std::vector<FileFace> faces;
  for (const AbaqusFace& face : surface.faces) {
    if (!face.elements.set.empty() && !find_abaqus(file.element_sets, face.elements.set)) continue;
    lookup.each_cell(face.elements, [&](std::size_t c) {
      const FileCell& cell = file.draft.cells[c];
      if (face.side < faces_of(cell.kind).size()) faces.push_back(face_of_cell(file.draft, cell, face, surface.name));
    });
  }
  if (!faces.empty()) file.draft.surfaces[surface.name] = std::move(faces);
}

void add_surface(AbaqusFile& file, AbaqusLookup& lookup, const AbaqusSurface& surface) {
  auto& faces = file.draft.surfaces[surface.name];
  for (const AbaqusFace& face : surface.faces) {
    if (face.side >= AbaqusFace::kPositive) {
      add_sides_of_shells(file, lookup, face, surface.name, faces);
      continue;
    }
    const std::size_t found = lookup.each_cell(face.elements, [&](std::size_t c) {
      faces.push_back(face_of_cell(file.draft, file.draft.cells[c], face, surface.name));
    });
    if (found == 0)
      file.draft.fail(face.elements.place, "surface {}: no such solid element", TextTokens::quoted(surface.name));
  }
}

}  // namespace

void add_abaqus_surfaces(AbaqusFile& file, AbaqusLookup& lookup) {
  for (const auto& [key, surface] : file.surfaces)
    if (surface.of_condition) add_loaded_faces(file, lookup, surface);
    else add_surface(file, lookup, surface);
  if (file.faces.empty()) return;
  for (const auto& [key, set] : file.element_sets) {
    std::vector<FileFace> found;
    lookup.each_face({.set = key}, [&](std::size_t f) { found.push_back(file.faces[f]); });
    if (!found.empty() && !file.draft.surfaces.contains(set.name)) file.draft.surfaces[set.name] = std::move(found);
  }
}

}  // namespace orthodyn
