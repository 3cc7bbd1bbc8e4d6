#include "lib/simulation/error_estimate/finer_model.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "lib/material_axes/axes_source.h"
#include "lib/mesh/element_of_shape.h"
#include "lib/mesh/quadratic.h"
#include "lib/mesh/refine.h"

namespace orthodyn {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;
using Barycentric = Eigen::Vector4d;

constexpr int kChildren = 8;

// Gives each fine element the material axes of its parent element.
class AxesOfParents : public AxesSource {
 public:
  AxesOfParents(std::shared_ptr<const AxesSource> source, std::shared_ptr<const Mesh> coarse, int children)
      : source_(std::move(source)), coarse_(std::move(coarse)), children_(children) {}
  bool uniform() const override { return source_->uniform(); }
  AxesField field(const Mesh&, Warnings& notes) const override {
    return [field = source_->field(*coarse_, notes), n = children_](const Vec3& point, int cell) {
      return field(point, cell / n);
    };
  }

 private:
  std::shared_ptr<const AxesSource> source_;
  std::shared_ptr<const Mesh> coarse_;
  int children_;
};

int children_of(const Mesh& coarse) { return coarse.order() == 1 ? 1 : kChildren; }

Scene finer(const Scene& scene, const Mesh& mesh) {
  Scene out = scene;
  const auto coarse = std::make_shared<const Mesh>(mesh);
  auto loaded = std::make_shared<LoadedMesh>();
  loaded->mesh = mesh;
  if (mesh.order() == 1) make_quadratic(loaded->mesh);
  else refine(*loaded);
  out.loaded = std::move(loaded);
  out.mass = MassKind::consistent;
  for (auto& [name, region] : out.regions)
    region.axes = std::make_shared<AxesOfParents>(region.axes, coarse, children_of(mesh));
  return out;
}

// Barycentric coordinates of a tetrahedron's node.
Barycentric place_of(std::size_t node) {
  if (node < 4) return Barycentric::Unit(static_cast<Eigen::Index>(node));
  const auto [i, j] = kTetEdges[node - 4];
  return (Barycentric::Unit(static_cast<Eigen::Index>(i)) + Barycentric::Unit(static_cast<Eigen::Index>(j))) / 2;
}

Barycentric place_in(std::span<const int> cell, int node) {
  return place_of(static_cast<std::size_t>(std::find(cell.begin(), cell.end(), node) - cell.begin()));
}

// The shape functions of a tetrahedron at a mid-edge node of one of its children, whose corners are nodes of it.
Vector shape_at_middle(std::span<const int> parent, std::span<const int> child, const std::vector<int>& edge) {
  const auto corner = [&](int k) { return child[static_cast<std::size_t>(k)]; };
  const Barycentric L = (place_in(parent, corner(edge[0])) + place_in(parent, corner(edge[1]))) / 2;
  return parent.size() == 4 ? Vector(L) : Vector(Tet10::shape(L));
}

// The shape functions of a hexahedron or wedge at the mean of these corners of its child; a linear one has itself as
// its only child.
Vector shape_in_child(CellShape shape, std::size_t child, const std::vector<int>& corners) {
  Vector out;
  with_element(shape, [&]<class E>() {
    if constexpr (HasIntegrationRules<E>) {
      Vec3 place = Vec3::Zero();
      for (const int k : corners)
        place +=
            E::kDegree == 1 ? Vec3(E::nodes().col(k)) : corners_of_children(shape)[child][static_cast<std::size_t>(k)];
      out = E::shape(place / static_cast<double>(corners.size()));
    }
  });
  return out;
}

}  // namespace

FinerModel::FinerModel(const Scene& scene, const FemModel& coarse)
    : coarse_(coarse), built_(build(finer(scene, coarse.parts().mesh))), nodal_(nodal_lift(model().parts().mesh)) {
  const DofMap &to = *model().parts().dofs, &from = *coarse.parts().dofs;
  Triplets entries;
  entries.reserve(static_cast<std::size_t>(3 * nodal_.nonZeros()));
  for (int node = 0; node < to.num_nodes(); ++node)
    for (Rows::InnerIterator at(nodal_, node); at; ++at)
      from.ties().for_each_leader(static_cast<int>(at.col()), [&](int leader, double weight) {
        for (std::size_t c = 0; c < 3; ++c) {
          const int row = to.node(node)[c], column = from.node(leader)[c];
          if (row >= 0 && column >= 0) entries.emplace_back(row, column, weight * at.value());
        }
      });
  lift_.resize(to.num_dofs(), from.num_dofs());
  lift_.setFromTriplets(entries.begin(), entries.end());
}

bool is_mixed(const FemModel& model) {
  const auto& elastic = model.parts().elastic;
  return std::any_of(elastic.begin(), elastic.end(), [](const auto& term) { return term->definition().mixed; });
}

bool is_nested(const FemModel& model) {
  const auto& elastic = model.parts().elastic;
  return !is_mixed(model) && std::none_of(elastic.begin(), elastic.end(), [](const auto& term) {
    return term->type().shape() == CellShape::hex20 && term->num_points() == 8;
  });
}

namespace {

// Nodes of the finer mesh per node of a mesh of 20-node hexahedra: with N nodes, C cells and F faces, of which B are on
// the surface, N' = N + 2 E + 5 F + 7 C and, by Euler's formula for a body without holes, 2 E = N - 1 + F - C.
double finer_nodes_of_hexahedra(const Mesh& mesh) {
  const auto N = static_cast<double>(mesh.nodes.size()), C = static_cast<double>(mesh.cells.size());
  const double F = (6 * C + static_cast<double>(boundary_faces(mesh).size())) / 2;
  return (2 * N + 6 * F + 6 * C - 1) / N;
}

bool has_only_20_node_hexahedra(const Mesh& mesh) {
  return std::ranges::all_of(mesh.cells.shapes(), [](CellShape shape) { return shape == CellShape::hex20; });
}

}  // namespace

double FinerModel::estimated_unknowns(const FemModel& coarse) {
  const Mesh& mesh = coarse.parts().mesh;
  if (has_only_20_node_hexahedra(mesh)) return finer_nodes_of_hexahedra(mesh) * coarse.num_dofs();
  return (mesh.order() == 2 || mesh.has_tets_only() ? 8.0 : 4.0) * coarse.num_dofs();
}

// Nodes of the coarse mesh keep their numbers.
FinerModel::Rows FinerModel::nodal_lift(const Mesh& fine) const {
  const Mesh& mesh = coarse_.parts().mesh;
  const auto children = static_cast<std::size_t>(children_of(mesh));
  std::vector<char> known(fine.nodes.size(), 0);
  std::fill_n(known.begin(), mesh.nodes.size(), 1);
  Triplets entries;
  for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node) entries.emplace_back(node, node, 1.0);
  for (std::size_t k = 0; k < fine.cells.size(); ++k) {
    const auto parent = mesh.cells[k / children], child = fine.cells[k];
    const CellShape shape = mesh.cells.shape(k / children);
    const bool is_tet = topology(shape).corners == 4;
    const CellTopology& cell = topology(fine.cells.shape(k));
    for (int a = is_tet ? cell.corners : 0; a < cell.nodes; ++a) {
      const int node = child[static_cast<std::size_t>(a)];
      if (std::exchange(known[static_cast<std::size_t>(node)], 1)) continue;
      const std::vector<int> corners =
          a < cell.corners ? std::vector{a} : cell.middles[static_cast<std::size_t>(a - cell.corners)];
      const Vector N = is_tet ? shape_at_middle(parent, child, corners) : shape_in_child(shape, k % children, corners);
      for (std::size_t b = 0; b < parent.size(); ++b)
        if (const double value = N[static_cast<Eigen::Index>(b)]; value != 0)
          entries.emplace_back(node, parent[b], value);
    }
  }
  Rows out(static_cast<Eigen::Index>(fine.nodes.size()), static_cast<Eigen::Index>(mesh.nodes.size()));
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

Vector FinerModel::state_of(double t, const ConstVectorRef& q) const {
  const NodalExpansion nodal(coarse_.parts(), t, q, Vector::Zero(q.size()));
  const NodalVector u = (nodal_ * nodal.u.transpose()).transpose();
  Vector out(model().num_dofs());
  model().parts().dofs->restrict_to(u, out);
  return out;
}

}  // namespace orthodyn
