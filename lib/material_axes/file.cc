// `axes: {type: file}`: the axes of each element from a file, measured or computed elsewhere.
#include <cmath>

#include "lib/material_axes/axes_rows.h"
#include "lib/material_axes/axes_source.h"
#include "lib/material_axes/frame.h"
#include "lib/material_axes/given_axes.h"

namespace orthodyn {
namespace {

class AxesFile : public AxesSource {
 public:
  static const Spec<AxesFile>& spec() {
    static const auto s =
        Spec<AxesFile>()
            .key("file", &AxesFile::file_,
                 "CSV with the columns a1x,a1y,a1z,a2x,a2y,a2z and optionally a3x,a3y,a3z and element (index from 0 "
                 "among the solid elements of the mesh file); without element, one row per element in mesh order. Or "
                 "VTU of the same mesh with the cell data axis_1, axis_2 and optionally axis_3, or axes (9 components: "
                 "axis 1, axis 2, axis 3). Or an Abaqus file (.inp) of the same mesh with section orientations. "
                 "Relative to the scene.",
                 {.required = true})
            .key("repair", &AxesFile::repair_, kRepairSentence);
    return s;
  }

  AxesField field(const Mesh& mesh, Warnings& notes) const override {
    const AxesRows given = read_axes_rows(file_, mesh.has_tets_only() ? FileCells::split : FileCells::keep);
    // CSV rows refer to elements of the mesh file, which may have been split into several cells.
    const std::vector<int> cell_of = given.mesh ? std::vector<int>{} : mesh.cell_of;
    const auto num_elements = given.mesh        ? given.mesh->cells.size()
                              : cell_of.empty() ? mesh.cells.size()
                                                : static_cast<std::size_t>(cell_of.back()) + 1;
    if (given.one_per_element && given.rows.size() != num_elements)
      throw ConfigError(
          given.path,
          fmt::format("{} rows for a mesh of {} elements{}; give one row per element, or a column 'element'",
                      given.rows.size(), num_elements,
                      cell_of.empty() ? "" : fmt::format(" (split into {} cells)", mesh.cells.size())));
    const std::size_t children = given.mesh ? children_in(given, mesh) : 1;
    if (given.mesh) check_same_mesh(given, mesh, children);
    auto axes = std::make_shared<std::vector<Mat3>>(num_elements, Mat3::Zero());
    for (const auto& row : given.rows) {
      if (static_cast<std::size_t>(row.element) >= num_elements)
        throw ConfigError(given.where(row), fmt::format("element {} does not exist; the mesh has 0 to {}", row.element,
                                                        num_elements - 1));
      Mat3& Q = (*axes)[static_cast<std::size_t>(row.element)];
      if (!Q.isZero(0)) throw ConfigError(given.where(row), fmt::format("element {} already has a row", row.element));
      Q = rotation(given, row);
    }
    note_repairs(given, notes);
    return [this, axes, cell_of, children](const Vec3&, int cell) {
      const int element = cell_of.empty() ? cell / static_cast<int>(children) : cell_of[static_cast<std::size_t>(cell)];
      const Mat3& Q = (*axes)[static_cast<std::size_t>(element)];
      if (Q.isZero(0)) throw ConfigError(file_.where, fmt::format("{} has no row for element {}", file_.path, element));
      return Q;
    };
  }

 private:
  // Number of children of each cell of the file after `refine`: 1, 8, 64, ... Children of a cell are consecutive
  // (lib/mesh/refine.h).
  static std::size_t children_in(const AxesRows& given, const Mesh& mesh) {
    const std::size_t there = given.mesh->cells.size(), here = mesh.cells.size();
    std::size_t children = 1;
    while (there * children < here) children *= 8;
    if (there * children != here)
      throw ConfigError(given.path,
                        fmt::format("{} cells for a mesh of {}; the axes belong to another mesh", there, here));
    return children;
  }

  // Mean of the centroids of the children of a cell, which is the centroid of the cell if its edges are straight.
  static Vec3 centre(const Mesh& mesh, std::size_t cell, std::size_t children) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < children; ++k) sum += centroid(mesh, static_cast<int>(cell * children + k));
    return sum / static_cast<double>(children);
  }

  // Checks that the elements of both meshes have the same positions up to a translation and a scale (`scale: 0.001` for
  // mm). Curved edges shift the children by less than a quarter of an element.
  static void check_same_mesh(const AxesRows& given, const Mesh& mesh, std::size_t children) {
    const std::size_t count = given.mesh->cells.size();
    if (count < 2) return;
    const auto extent = [&](const Mesh& m, std::size_t of_each) {
      Box box{centre(m, 0, of_each), centre(m, 0, of_each)};
      for (std::size_t e = 1; e < count; ++e) {
        const Vec3 c = centre(m, e, of_each);
        box = {box.min.cwiseMin(c), box.max.cwiseMax(c)};
      }
      return box;
    };
    const Box there = extent(*given.mesh, 1), here = extent(mesh, children);
    for (std::size_t e = 0; e < count; ++e) {
      const Vec3 a = (centre(*given.mesh, e, 1) - there.min) / there.diagonal(),
                 b = (centre(mesh, e, children) - here.min) / here.diagonal();
      const double size = std::cbrt(6 * std::abs(cell_volume(*given.mesh, e))) / there.diagonal();
      if (!((a - b).norm() < (children == 1 ? 1e-4 : std::max(1e-4, 0.25 * size))))
        throw ConfigError(given.path,
                          fmt::format("cell {} and element {} of the scene's mesh have different positions; the axes "
                                      "belong to another mesh, or its elements or nodes have another order",
                                      e, e));
    }
  }

  // The axes with unit length; axis 3 is added if it is missing.
  static Mat3 columns(const AxesRows& given, const AxesRows::Row& row) {
    Mat3 m;
    for (int i = 0; i < 3; ++i) m.col(i) = row.columns.col(i).stableNormalized();
    if (!given.has_third) m.col(2) = m.col(0).cross(m.col(1)).stableNormalized();
    return m;
  }

  Mat3 rotation(const AxesRows& given, const AxesRows::Row& row) const {
    const Mat3 m = columns(given, row);
    check_axes(m, repair_, [&](const std::string& sentence) { throw ConfigError(given.where(row), sentence); });
    return nearest_axes(m);
  }

  void note_repairs(const AxesRows& given, Warnings& notes) const {
    if (repair_ == AxesRepair::refuse) return;
    std::size_t count = 0;
    std::string first;
    for (const auto& row : given.rows) {
      const auto note = repair_note(columns(given, row));
      if (note.empty()) continue;
      if (count++ == 0) first = fmt::format("{}: {}", given.where(row), note);
    }
    if (count > 0)
      notes.push_back(fmt::format("{} of {} axes were repaired, the first at {}", count, given.rows.size(), first));
  }

  FilePath file_;
  AxesRepair repair_ = AxesRepair::refuse;
};

const bool axes_file_registered = Registry<AxesSource>::add<AxesFile>("file", "The axes of each element from a file.");

}  // namespace
}  // namespace orthodyn
