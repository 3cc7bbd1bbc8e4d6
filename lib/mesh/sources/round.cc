// The mesh sources `cylinder` and `tube`.
#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <type_traits>

#include "lib/mesh/cylinder.h"
#include "lib/mesh/mesh_source.h"
#include "lib/mesh/sources/source_keys.h"

namespace orthodyn {

template <>
struct EnumNames<RoundMesh::Elements> {
  static constexpr std::array<std::pair<RoundMesh::Elements, const char*>, 2> list{
      {{RoundMesh::Elements::tetrahedra, "tetrahedra"}, {RoundMesh::Elements::hexahedra, "hexahedra"}}};
};

namespace {

constexpr Range kGrading{0.01, 100};

// Keys of both sources. `Round` is CylinderMesh or TubeMesh.
template <class Round>
class RoundSource : public MeshSource, public Round {
 public:
  RoundSource() { this->order = kDefaultOrder; }

  std::array<int, 3> counts{16, 2, 8};
  double grading = 1;

 protected:
  // The description of the mesh with the cell counts and the grading from the keys.
  Round mesh() const {
    Round mesh = *this;
    mesh.cells = {.around = counts[0], .through = counts[1], .along = counts[2], .grading = grading};
    mesh.elements = elements_.value_or(this->order == 2 && flatness() > kPlate ? RoundMesh::Elements::hexahedra
                                                                               : RoundMesh::Elements::tetrahedra);
    return mesh;
  }

  template <class S>
  static Spec<S> common_spec() {
    return Spec<S>()
        .key("radius", &S::radius, "Outer radius.", {.required = true, .unit = "m", .range = kPositive})
        .key("length", &S::length, "Length along the axis.", {.required = true, .unit = "m", .range = kPositive})
        .key("cells", &S::counts, "Cells around, through (rings), along.", {.required = true, .range = {1, 1e6}})
        .key("grading", &S::grading, "Thickness of the outermost ring divided by that of the innermost.",
             {.range = kGrading})
        .key("elements", &S::elements_,
             "tetrahedra, or hexahedra of 20 nodes (8 with `order: 1`). Default: hexahedra if the cells are more than "
             "four times wider than thick, as in thin tubes, discs and washers, unless `order: 1` is given; otherwise "
             "tetrahedra.")
        .key("order", &S::order, kOrderSentence, kOrderRule)
        .key("origin", &S::origin, "Centre of end0.", {.unit = "m"})
        .key("axis", &S::axis, "Direction from end0 to end1, of any length.")
        .check([](const S& source, const Config& config) {
          const auto [around, through, along] = source.counts;
          const auto elements = source.mesh().elements;
          if (!source.elements_) config.fill("elements", Value<RoundMesh::Elements>::yaml(elements));
          const double per_cell = elements == RoundMesh::Elements::hexahedra ? 1 : 6;
          check_mesh_size(per_cell * S::cells_per_layer(around, through) * along, config.at("cells"));
          if (source.axis.norm() == 0) config.at("axis").fail("is zero; give a direction");
        });
  }

 private:
  // The second smallest edge of the cells over the smallest, by their mean sizes.
  double flatness() const {
    std::array edges{2 * std::numbers::pi * this->radius / counts[0], radial_size(), this->length / counts[2]};
    std::sort(edges.begin(), edges.end());
    return edges[1] / edges[0];
  }
  double radial_size() const {
    if constexpr (std::is_same_v<Round, TubeMesh>) return (this->radius - this->inner_radius) / counts[1];
    else return this->radius / (counts[1] + counts[0] / 8.0);  // rings, and half of the core's cells
  }

  static constexpr double kPlate = 4;
  std::optional<RoundMesh::Elements> elements_;
};

class CylinderSource : public RoundSource<CylinderMesh> {
 public:
  static const Spec<CylinderSource>& spec() {
    static const auto s = common_spec<CylinderSource>().check([](const CylinderSource& c, const Config& config) {
      if (c.counts[0] % 4 != 0) config.at("cells").at(0).fail("must be a multiple of 4 around a full cylinder");
    });
    return s;
  }
  LoadedMesh load() const override { return {.mesh = make_cylinder(mesh())}; }

  // In the rings and the core.
  static double cells_per_layer(double around, double through) { return around * through + around * around / 16; }
};

class TubeSource : public RoundSource<TubeMesh> {
 public:
  static const Spec<TubeSource>& spec() {
    static const auto s = common_spec<TubeSource>()
                              .key("inner_radius", &TubeSource::inner_radius, "Inner radius.",
                                   {.required = true, .unit = "m", .range = kPositive})
                              .check([](const TubeSource& t, const Config& config) {
                                if (t.counts[0] < 3) config.at("cells").at(0).fail("must be at least 3 around");
                                if (t.inner_radius >= t.radius)
                                  config.at("inner_radius").fail("must be smaller than the radius");
                              });
    return s;
  }
  LoadedMesh load() const override { return {.mesh = make_tube(mesh())}; }

  static double cells_per_layer(double around, double through) { return around * through; }
};

const bool round_registered[] = {
    Registry<MeshSource>::add<CylinderSource>("cylinder",
                                              "A solid cylinder. The cells of its core form a square of around/4 x "
                                              "around/4. Region: body. Surfaces: end0, end1, outer."),
    Registry<MeshSource>::add<TubeSource>("tube",
                                          "A hollow cylinder. Region: body. Surfaces: end0, end1, outer, inner."),
};

}  // namespace
}  // namespace orthodyn
