// The mesh sources `cylinder` and `tube`.
#include "lib/mesh/cylinder.h"
#include "lib/mesh/mesh_source.h"
#include "lib/mesh/sources/element_order.h"
#include "lib/mesh/sources/number_of_elements.h"

namespace orthodyn {
namespace {

constexpr Range kGrading{0.01, 100};

// What both have in common. `Mesh` is CylinderMesh or TubeMesh, `S` the source.
template <class S, class Mesh>
Spec<S> round_spec() {
  return Spec<S>()
      .key("radius", &Mesh::radius, "Outer radius.", {.required = true, .unit = "m", .range = kPositive})
      .key("length", &Mesh::length, "Length along the axis.", {.required = true, .unit = "m", .range = kPositive})
      .key("cells", &S::counts, "Cells around, through (rings), along.", {.required = true, .range = {1, 1e6}})
      .key("grading", &S::grading, "Thickness of the outermost ring over that of the innermost.", {.range = kGrading})
      .key("order", &Mesh::order, kOrderSentence, kOrderRule)
      .key("origin", &Mesh::origin, "Centre of end0.", {.unit = "m"})
      .key("axis", &Mesh::axis, "Direction from end0 to end1, of any length.")
      .check([](const S& source, const Config& config) {
        const auto [around, through, along] = source.counts;
        require_room(S::tets(around, through) * along, config.at("cells"));
        if (source.axis.norm() == 0) config.at("axis").fail("is zero; give a direction");
      });
}

RoundCells cells_of(const std::array<int, 3>& counts, double grading) {
  return {.around = counts[0], .through = counts[1], .along = counts[2], .grading = grading};
}

class CylinderSource : public MeshSource, public CylinderMesh {
 public:
  CylinderSource() { order = kDefaultOrder; }
  static const Spec<CylinderSource>& spec() {
    static const auto s =
        round_spec<CylinderSource, CylinderMesh>().check([](const CylinderSource& c, const Config& config) {
          if (c.counts[0] % 4 != 0) config.at("cells").at(0).fail("must be a multiple of 4 around a full cylinder");
        });
    return s;
  }
  LoadedMesh load() const override {
    CylinderMesh cylinder = *this;
    cylinder.cells = cells_of(counts, grading);
    return {.mesh = make_cylinder(cylinder)};
  }

  // Of a layer: three for each triangle of rings and core.
  static double tets(double around, double through) { return 6 * (around * through + around * around / 16); }

  std::array<int, 3> counts{16, 2, 8};
  double grading = 1;
};

class TubeSource : public MeshSource, public TubeMesh {
 public:
  TubeSource() { order = kDefaultOrder; }
  static const Spec<TubeSource>& spec() {
    static const auto s = round_spec<TubeSource, TubeMesh>()
                              .key("inner_radius", &TubeMesh::inner_radius, "Inner radius.",
                                   {.required = true, .unit = "m", .range = kPositive})
                              .check([](const TubeSource& t, const Config& config) {
                                if (t.counts[0] < 3) config.at("cells").at(0).fail("must be at least 3 around");
                                if (t.inner_radius >= t.radius)
                                  config.at("inner_radius").fail("must be smaller than the radius");
                              });
    return s;
  }
  LoadedMesh load() const override {
    TubeMesh tube = *this;
    tube.cells = cells_of(counts, grading);
    return {.mesh = make_tube(tube)};
  }

  static double tets(double around, double through) { return 6 * around * through; }  // of a layer

  std::array<int, 3> counts{16, 2, 8};
  double grading = 1;
};

const bool round_registered[] = {
    Registry<MeshSource>::add<CylinderSource>(
        "cylinder",
        "A full cylinder with a square core of around/4 cells a side. Region: body. Surfaces: end0, end1, outer."),
    Registry<MeshSource>::add<TubeSource>("tube",
                                          "A hollow cylinder. Region: body. Surfaces: end0, end1, outer, inner."),
};

}  // namespace
}  // namespace orthodyn
