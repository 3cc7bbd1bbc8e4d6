// box, gmsh.
#include <filesystem>

#include "lib/mesh/box.h"
#include "lib/scene/mesh_source.h"

namespace orthodyn {

template <>
struct Words<BoxMesh::Split> {
  static constexpr std::array<std::pair<BoxMesh::Split, const char*>, 2> list{
      {{BoxMesh::Split::five, "five"}, {BoxMesh::Split::six, "six"}}};
};

namespace {

class BoxSource : public MeshSource, public BoxMesh {
 public:
  static const Spec<BoxSource>& spec() {
    static const auto s =
        Spec<BoxSource>()
            .key("size", &BoxMesh::size, "Edge lengths.", {.required = true, .unit = "m", .range = kPositive})
            .key("cells", &BoxMesh::cells, "Cells along x, y, z.", {.required = true, .range = {1, 1e6}})
            .key("origin", &BoxMesh::origin, "The corner with the lowest coordinates.", {.unit = "m"})
            .key("split", &BoxMesh::split,
                 "Tets per cell: five (mirror symmetric for even cells) or six (all cells alike).")
            .check([](const BoxSource& box, const Config& config) {
              const double tets = 6.0 * box.cells[0] * box.cells[1] * box.cells[2];
              if (tets > 5e8) config.at("cells").fail("more than 5e8 elements; use fewer cells");
            });
    return s;
  }
  LoadedMesh load() const override { return {make_box(*this), {}}; }
};

class GmshSource : public MeshSource {
 public:
  static const Spec<GmshSource>& spec() {
    static const auto s =
        Spec<GmshSource>()
            .key("file", &GmshSource::file_, "A .msh file, ASCII, version 2.2 or 4.1; relative to the scene.",
                 {.required = true})
            .key("scale", &GmshSource::scale_, "Multiplies coordinates: 0.001 if they are in mm.",
                 {.range = kPositive});
    return s;
  }
  LoadedMesh load() const override {
    if (!std::filesystem::is_regular_file(file_.path))
      throw ConfigError(file_.where + ": no such file: " + file_.path);
    LoadedMesh loaded = read_gmsh(file_.path);
    for (Vec3& x : loaded.mesh.nodes) x *= scale_;
    return loaded;
  }

 private:
  FilePath file_;
  double scale_ = 1;
};

const bool registered[] = {
    Registry<MeshSource>::add<BoxSource>(
        "box", "A box of tetrahedra. Region: body. Surfaces: x0, x1, y0, y1, z0, z1."),
    Registry<MeshSource>::add<GmshSource>(
        "gmsh", "A Gmsh file. Physical volumes become regions, physical surfaces surfaces."),
};

}  // namespace
}  // namespace orthodyn
