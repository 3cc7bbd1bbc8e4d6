#include "lib/mesh/io/abaqus_layups.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/mesh/io/abaqus_axes.h"
#include "lib/mesh/io/text_tokens.h"
#include "lib/mesh/stack.h"

namespace orthodyn {
namespace {

constexpr double kSameAxis = 1e-6;  // largest difference of two unit vectors that count as equal

// The corners at the beginning and the end of a cell along the stack direction 1, 2 or 3; empty if it has none.
struct Ends {
  std::vector<std::size_t> begin, end;
};
Ends ends_along(CellKind kind, int direction) {
  if (kind == CellKind::wedge) return direction == 3 ? Ends{{0, 1, 2}, {3, 4, 5}} : Ends{};
  if (kind != CellKind::hexahedron) return {};
  if (direction == 1) return {{0, 3, 4, 7}, {1, 2, 5, 6}};
  if (direction == 2) return {{0, 1, 4, 5}, {2, 3, 6, 7}};
  return {{0, 1, 2, 3}, {4, 5, 6, 7}};
}

// The unit vector from the first to the last ply of a cell.
Vec3 stack_direction(const AbaqusFile& file, const AbaqusLookup& lookup, const AbaqusSection& section,
                     const FileCell& cell) {
  const auto [begin, end] = ends_along(cell.kind, section.stack_direction);
  if (begin.empty())
    file.draft.fail(section.elements.place,
                    "*SOLID SECTION, COMPOSITE: element {} has no stack direction {}; plies need hexahedra, or wedges "
                    "with STACK DIRECTION=3",
                    cell.tag, section.stack_direction);
  const auto centre = [&](const std::vector<std::size_t>& corners) {
    Vec3 sum = Vec3::Zero();
    for (const std::size_t c : corners) sum += lookup.position(cell.nodes[c], cell.place);
    return Vec3(sum / static_cast<double>(corners.size()));
  };
  return (centre(end) - centre(begin)).normalized();
}

// Angle (degrees) about axis 3 from the axes `base` to the axes `ply`.
double angle_between(const AbaqusFile& file, const AbaqusPly& ply, const Mat3& base, const Mat3& axes) {
  if ((axes.col(2) - base.col(2)).norm() > kSameAxis)
    file.draft.fail(ply.place,
                    "the orientation {} of a ply does not share axis 3 with the section; only turns about "
                    "axis 3 are supported",
                    TextTokens::quoted(ply.orientation));
  return std::atan2(axes.col(0).dot(base.col(1)), axes.col(0).dot(base.col(0))) * 180 / std::numbers::pi;
}

// Makes the layup of one region.
class LayupMaker {
 public:
  LayupMaker(const AbaqusFile& file, AbaqusLookup& lookup, const std::vector<Mat3>& axes)
      : file_(file), lookup_(lookup), axes_(axes) {}

  std::vector<MeshPly> of(const AbaqusSection& section, const std::vector<std::size_t>& cells) const {
    std::vector<MeshPly> plies;
    for (const AbaqusPly& ply : section.plies)
      plies.push_back(
          {abaqus_material(file_, ply.material, ply.place), degrees_of(section, ply, cells), ply.thickness});
    if (is_reversed(section, cells)) std::reverse(plies.begin(), plies.end());
    return plies;
  }

 private:
  Mat3 axes_of(std::size_t cell) const { return axes_.empty() ? Mat3(Mat3::Identity()) : axes_[cell]; }

  // Whether the first ply is at the top, seen along axis 3.
  bool is_reversed(const AbaqusSection& section, const std::vector<std::size_t>& cells) const {
    int up = 0;
    for (const std::size_t c : cells) {
      const FileCell& cell = file_.draft.cells[c];
      const double cosine = stack_direction(file_, lookup_, section, cell).dot(axes_of(c).col(2));
      if (std::abs(cosine) < kAlongStack || (up != 0 && (cosine > 0) != (up > 0)))
        file_.draft.fail(section.elements.place,
                         "*SOLID SECTION, COMPOSITE: the plies of element {} are {}; number its nodes, or set the "
                         "*ORIENTATION or STACK DIRECTION, so that stack direction and axis 3 agree",
                         cell.tag,
                         std::abs(cosine) < kAlongStack
                             ? "not stacked along axis 3 of the section's orientation"
                             : "stacked in the opposite direction to those of other elements");
      up = cosine > 0 ? 1 : -1;
    }
    return up < 0;
  }

  double degrees_of(const AbaqusSection& section, const AbaqusPly& ply, const std::vector<std::size_t>& cells) const {
    if (ply.orientation.empty() || ply.orientation == section.orientation) return ply.degrees;
    const AbaqusOrientation* orientation = find_abaqus(file_.orientations, ply.orientation);
    if (!orientation)
      file_.draft.fail(ply.place, "the file has no *ORIENTATION {}, which a ply uses",
                       TextTokens::quoted(ply.orientation));
    const AbaqusAxes own(file_, *orientation, lookup_);
    const auto angle_at = [&](std::size_t c) {
      return angle_between(file_, ply, axes_of(c), own.of(c, centre_of(file_.draft.cells[c], lookup_)));
    };
    const double degrees = angle_at(cells.front());
    for (const std::size_t c : cells)
      if (std::abs(std::remainder(angle_at(c) - degrees, 360)) > 1e-4)
        file_.draft.fail(ply.place,
                         "the angle between the orientation {} of a ply and that of the section varies among elements; "
                         "give an angle instead",
                         TextTokens::quoted(ply.orientation));
    return degrees;
  }

  const AbaqusFile& file_;
  AbaqusLookup& lookup_;
  const std::vector<Mat3>& axes_;
};

}  // namespace

Vec3 centre_of(const FileCell& cell, const AbaqusLookup& lookup) {
  Vec3 sum = Vec3::Zero();
  for (const std::int64_t node : cell.corners()) sum += lookup.position(node, cell.place);
  return sum / static_cast<double>(cell.corners().size());
}

MeshMaterial abaqus_material(const AbaqusFile& file, const std::string& name, FilePlace section) {
  const auto found = file.materials.find(name);
  if (found != file.materials.end()) return mesh_material(found->second, file.draft);
  return {.name = name, .where = file.draft.where(section), .problem = "the file has no such *MATERIAL"};
}

void complete_composites(AbaqusFile& file) {
  for (AbaqusSection& section : file.sections)
    if (section.orientation.empty() && !section.plies.empty()) section.orientation = section.plies.front().orientation;
}

std::map<std::string, std::vector<MeshPly>> layups_of_regions(const AbaqusFile& file, AbaqusLookup& lookup,
                                                              const AbaqusRegions& regions,
                                                              const std::vector<Mat3>& axes) {
  std::map<std::string, std::vector<MeshPly>> layups;
  const LayupMaker maker(file, lookup, axes);
  for (const auto& [region, section] : regions.section_of_region) {
    if (section->plies.empty()) continue;
    std::vector<std::size_t> cells;
    for (std::size_t c = 0; c < regions.section_of_cell.size(); ++c)
      if (regions.section_of_cell[c] == section) cells.push_back(c);
    layups.emplace(region, maker.of(*section, cells));
  }
  return layups;
}

}  // namespace orthodyn
