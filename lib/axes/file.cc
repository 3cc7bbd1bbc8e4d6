// `axes: {type: file}`: the axes of each element from a file, as measured or as computed elsewhere.
#include "lib/axes/axes_rows.h"
#include "lib/axes/axes_source.h"
#include "lib/axes/frame.h"
#include "lib/axes/given_axes.h"

namespace orthodyn {
namespace {

class AxesFile : public AxesSource {
 public:
  static const Spec<AxesFile>& spec() {
    static const auto s =
        Spec<AxesFile>()
            .key("file", &AxesFile::file_,
                 "CSV with the columns a1x,a1y,a1z,a2x,a2y,a2z and optionally a3x,a3y,a3z and element (index from 0, "
                 "as the mesh file counts its solid elements). "
                 "Without element there is one row for each element of the mesh, in its order. Or VTU of the same mesh "
                 "with the "
                 "cell data axis_1, axis_2 and optionally axis_3, or axes (9 components: axis 1, axis 2, axis 3). "
                 "Or an Abaqus file (.inp) of the same mesh, for the orientations of its sections; relative to the "
                 "scene.",
                 {.required = true})
            .key("repair", &AxesFile::repair_, kRepairSentence);
    return s;
  }

  AxesField field(const TetMesh& mesh, Warnings& notes) const override {
    const AxesRows given = read_axes_rows(file_);
    // Rows of CSV stand for the elements of the mesh file, from which several tets may have been cut.
    const std::vector<int> cell_of = given.mesh ? std::vector<int>{} : mesh.cell_of;
    const auto num_elements = cell_of.empty() ? mesh.tets.size() : static_cast<std::size_t>(cell_of.back()) + 1;
    if (given.every && given.rows.size() != num_elements)
      throw ConfigError(
          given.path,
          fmt::format("{} rows for a mesh of {} elements{}; give one for each, or a column 'element'",
                      given.rows.size(), num_elements,
                      cell_of.empty() ? "" : fmt::format(" (split into {} tetrahedra)", mesh.tets.size())));
    if (given.mesh) check_same_mesh(given, mesh);
    auto axes = std::make_shared<std::vector<Mat3>>(num_elements, Mat3::Zero());
    for (const auto& row : given.rows) {
      if (static_cast<std::size_t>(row.element) >= num_elements)
        throw ConfigError(given.where(row), fmt::format("element {} does not exist; the mesh has 0 to {}", row.element,
                                                        num_elements - 1));
      Mat3& Q = (*axes)[static_cast<std::size_t>(row.element)];
      if (!Q.isZero(0))
        throw ConfigError(given.where(row), fmt::format("element {} already has a row", row.element));
      Q = rotation(given, row);
    }
    note_repairs(given, notes);
    return [this, axes, cell_of](const Vec3&, int tet) {
      const int element = cell_of.empty() ? tet : cell_of[static_cast<std::size_t>(tet)];
      const Mat3& Q = (*axes)[static_cast<std::size_t>(element)];
      if (Q.isZero(0))
        throw ConfigError(file_.where, fmt::format("{} has no row for element {}", file_.path, element));
      return Q;
    };
  }

 private:
  // That elements lie in the same places up to a shift and a scale (`scale: 0.001` of a mesh in mm).
  static void check_same_mesh(const AxesRows& given, const TetMesh& mesh) {
    const int count = static_cast<int>(mesh.tets.size());
    const auto extent = [&](const TetMesh& m) {
      Box box{centroid(m, 0), centroid(m, 0)};
      for (int e = 1; e < count; ++e) {
        const Vec3 c = centroid(m, e);
        box = {box.min.cwiseMin(c), box.max.cwiseMax(c)};
      }
      return box;
    };
    const Box there = extent(*given.mesh), here = extent(mesh);
    if (count < 2) return;
    for (int e = 0; e < count; ++e) {
      const Vec3 a = (centroid(*given.mesh, e) - there.min) / there.diagonal(),
                 b = (centroid(mesh, e) - here.min) / here.diagonal();
      if (!((a - b).norm() < 1e-4))
        throw ConfigError(given.path,
                          fmt::format("cell {} is not where element {} of the scene's mesh is; the axes are of another "
                                      "mesh, or its elements or nodes have another order",
                                      e, e));
    }
  }

  // Of unit length, with the third filled in.
  static Mat3 columns(const AxesRows& given, const AxesRows::Row& row) {
    Mat3 m;
    for (int i = 0; i < 3; ++i) m.col(i) = row.columns.col(i).stableNormalized();
    if (!given.third) m.col(2) = m.col(0).cross(m.col(1)).stableNormalized();
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
