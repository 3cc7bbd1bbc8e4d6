// The mesh source `box`.
#include "lib/mesh/box.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

#include "lib/mesh/mesh_source.h"
#include "lib/mesh/selection.h"
#include "lib/mesh/sources/source_keys.h"

namespace orthodyn {

template <>
struct EnumNames<BoxMesh::Split> {
  static constexpr std::array<std::pair<BoxMesh::Split, const char*>, 2> list{
      {{BoxMesh::Split::five, "five"}, {BoxMesh::Split::six, "six"}}};
};

namespace {

// The last two have nodes in the middle of quadrilaterals and hexahedra.
enum class BoxElements { tetrahedra, wedges, hexahedra, wedges_18, hexahedra_27 };

}  // namespace

template <>
struct EnumNames<BoxElements> {
  static constexpr std::array<std::pair<BoxElements, const char*>, 5> list{
      {{BoxElements::tetrahedra, "tetrahedra"},
       {BoxElements::wedges, "wedges"},
       {BoxElements::hexahedra, "hexahedra"},
       {BoxElements::wedges_18, "wedges_18"},
       {BoxElements::hexahedra_27, "hexahedra_27"}}};
};

namespace {

bool has_centres(BoxElements elements) {
  return elements == BoxElements::wedges_18 || elements == BoxElements::hexahedra_27;
}

BoxMesh::Elements cells_of(BoxElements elements) {
  switch (elements) {
    case BoxElements::tetrahedra: return BoxMesh::Elements::tetrahedra;
    case BoxElements::wedges:
    case BoxElements::wedges_18: return BoxMesh::Elements::wedges;
    default: return BoxMesh::Elements::hexahedra;
  }
}

// Makes a region of the elements with their centroid in `part`; takes them from earlier parts.
void add_region(Mesh& mesh, const std::string& name, const BoxSelection& part) {
  if (name == mesh.region_names.front())
    part.origin.fail("'" + name + "' is the region of the remaining elements; choose another name");
  const int region = static_cast<int>(mesh.region_names.size());
  mesh.region_names.push_back(name);
  bool any = false;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    if (!part.contains(centroid(mesh, static_cast<int>(e)))) continue;
    mesh.region_of[e] = region;
    any = true;
  }
  if (!any) part.origin.fail("no element has its centroid in this part; widen it, or use more cells");
}

class BoxSource : public MeshSource, public BoxMesh {
 public:
  static const Spec<BoxSource>& spec() {
    static const auto s =
        Spec<BoxSource>()
            .key("size", &BoxMesh::size, "Edge lengths.", {.required = true, .unit = "m", .range = kPositive})
            .key("cells", &BoxMesh::cells, "Cells along x, y, z.", {.required = true, .range = {1, 1e6}})
            .key("origin", &BoxMesh::origin, "The corner with the lowest coordinates.", {.unit = "m"})
            .key("layers", &BoxMesh::layers,
                 "Heights of the cells along z from bottom to top, in proportion to each other: one per cell along z. "
                 "Default: all equal.",
                 {.range = kPositive})
            .key("elements", &BoxSource::elements_,
                 "tetrahedra; hexahedra: one of 20 nodes per cell, for plates and other thin bodies; wedges: two of 15 "
                 "nodes per "
                 "cell, with triangles in planes of constant z (8 and 6 nodes with `order: 1`). hexahedra_27, "
                 "wedges_18: "
                 "with nodes in the middle of quadrilaterals and cells, for nearly incompressible materials. Default: "
                 "hexahedra for cells more than four times wider than thick, unless `order: 1` or `split` is given; "
                 "otherwise tetrahedra.")
            .key("split", &BoxSource::split_,
                 "Tets per cell: five (mirror symmetric for even cell counts) or six (all cells alike). Default: six "
                 "for quadratic tetrahedra in cells more than three times wider than thick, where five are far too "
                 "stiff; otherwise five.")
            .key("order", &BoxSource::order, kOrderSentence, kOrderRule)
            .key("parts", &BoxSource::parts_,
                 "Further regions by name: the elements whose centroid lies between `min` and `max`.")
            .check([](const BoxSource& box, const Config& config) {
              if (!box.layers.empty() && box.layers.size() != static_cast<std::size_t>(box.cells[2]))
                config.at("layers").fail(
                    fmt::format("has {} heights, but there are {} cells along z", box.layers.size(), box.cells[2]));
              const BoxElements elements = box.chosen_elements();
              if (!box.elements_) config.fill("elements", Value<BoxElements>::yaml(elements));
              if (has_centres(elements) && box.order == 1)
                config.at("order").fail("linear elements have 6 or 8 nodes; remove it, or the number in `elements`");
              if (elements != BoxElements::tetrahedra) {
                if (box.split_) config.at("split").fail("divides cells into tetrahedra; remove it, or `elements`");
                return check_mesh_size(
                    (cells_of(elements) == Elements::wedges ? 2.0 : 1.0) * box.cells[0] * box.cells[1] * box.cells[2],
                    config.at("cells"));
              }
              if (!box.split_) config.fill("split", Value<Split>::yaml(box.chosen_split()));
              const double tets_per_cell = box.chosen_split() == BoxMesh::Split::five ? 5 : 6;
              check_mesh_size(tets_per_cell * box.cells[0] * box.cells[1] * box.cells[2], config.at("cells"));
            });
    return s;
  }
  LoadedMesh load() const override {
    BoxMesh box = *this;
    box.elements = cells_of(chosen_elements());
    box.split = chosen_split();
    Mesh mesh = make_box(box);
    for (const auto& [name, part] : parts_) add_region(mesh, name, part);
    set_order(mesh, order);
    if (has_centres(chosen_elements())) add_centres(mesh);
    return {std::move(mesh), {}};
  }

  int order = kDefaultOrder;

 private:
  BoxElements chosen_elements() const {
    const bool is_plate = order == 2 && !split_ && flatness() > kPlate;
    return elements_.value_or(is_plate ? BoxElements::hexahedra : BoxElements::tetrahedra);
  }
  Split chosen_split() const { return split_.value_or(order == 2 && flatness() > kFlat ? Split::six : Split::five); }
  // Smaller width of the cells over their thickness, of the thinnest cells.
  double flatness() const {
    std::array<double, 3> edges;
    for (std::size_t i = 0; i < 3; ++i) edges[i] = size[static_cast<Eigen::Index>(i)] / cells[i];
    if (!layers.empty())
      edges[2] = size[2] * *std::min_element(layers.begin(), layers.end()) /
                 std::accumulate(layers.begin(), layers.end(), 0.0);
    std::sort(edges.begin(), edges.end());
    return edges[1] / edges[0];
  }

  static constexpr double kFlat = 3, kPlate = 4;
  std::optional<BoxElements> elements_;
  std::optional<Split> split_;
  Named<BoxSelection> parts_;
};

const bool box_registered = Registry<MeshSource>::add<BoxSource>(
    "box", "A box of tetrahedra, wedges or hexahedra. Region: body, and `parts`. Surfaces: x0, x1, y0, y1, z0, z1.");

}  // namespace
}  // namespace orthodyn
