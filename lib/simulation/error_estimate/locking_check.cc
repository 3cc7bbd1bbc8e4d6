#include "lib/simulation/error_estimate/locking_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/fem/element_mesh.h"
#include "lib/material/stiffness_contrast.h"
#include "lib/mesh/cell_volume.h"

namespace orthodyn {

namespace {

constexpr double kFlat = 6;     // width of cells over thickness: above it, they are flat
constexpr double kBends = 0.3;  // share of the squared strains that varies within cells

// Ratios of the largest to the smallest eigenvalue of the stiffness above which elements of this order lock.
double stiff_volume(int order) { return order == 1 ? 30 : 300; }
double stiff_direction(int order) { return order == 1 ? 1000 : 5000; }

// Longest edge over smallest height of a cell with straight edges.
double flatness(const Mesh& mesh, std::size_t cell) {
  const CellTopology& shape = topology(mesh.cells.shape(cell));
  double longest = 0, largest = 0;  // edge, face area
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    const auto corners = static_cast<std::size_t>(shape.corners_of_face(f));
    const auto at = [&](std::size_t k) -> const Vec3& {
      return mesh.node(mesh.cells[cell][static_cast<std::size_t>(shape.faces[f][k % corners])]);
    };
    for (std::size_t k = 0; k < corners; ++k) longest = std::max(longest, (at(k + 1) - at(k)).norm());
    largest = std::max(largest, (at(2) - at(0)).cross(at(corners - 1) - at(1)).norm() / 2);
  }
  return longest * largest / ((shape.corners == 4 ? 3 : 1) * std::abs(cell_volume(mesh, cell)));
}

// Quadratic hexahedra and wedges do not lock if they are flat.
bool may_lock(const CellTopology& shape) { return shape.corners == 4 || shape.order == 1; }

// Of the elements that may lock.
struct Bending {
  double share = 0;     // part of the squared strains that varies within cells; 0 for linear tetrahedra
  double flatness = 0;  // mean, weighted by squared strains
};

Bending bending(const FemModel& model, const State& state) {
  const FemModel::Parts& parts = model.parts();
  const NodalExpansion nodal(parts, state.t, state.q, Vector::Zero(state.q.size()));
  double all = 0, varying = 0, flat = 0;
  for (const auto& term : parts.elastic) {
    if (term->size() == 0 || !may_lock(topology(term->type().shape()))) continue;
    const auto strains = term->strains(nodal.state());
    const Eigen::Index points = term->num_points();
    for (int k = 0; k < term->size(); ++k) {
      const auto own = strains.middleCols(points * k, points);
      const Vec6 mean = own.rowwise().mean();
      const auto cell = static_cast<std::size_t>(term->cell(k));
      const double volume = std::abs(cell_volume(parts.mesh, cell));
      const double square = volume * own.squaredNorm();
      all += square;
      varying += volume * (own.colwise() - mean).squaredNorm();
      flat += square * flatness(parts.mesh, cell);
    }
  }
  if (!(all > 0)) return {};
  return {varying / all, flat / all};
}

std::string flat_cells(const FemModel& model, const State& state) {
  const auto [share, flatness] = bending(model, state);
  const int order = model.parts().mesh.order();
  if (!(flatness > kFlat) || (order == 2 && share < kBends)) return "";
  return fmt::format(
      "cells are {:.0f} times as wide as thick{}: {} are then too stiff (locking), and the true error may be several "
      "times the estimate. Use narrower cells{}, or check with orthodyn converge",
      flatness, order == 1 ? ", and where the body bends" : ", and the body bends",
      order == 1 ? "linear elements" : "quadratic tetrahedra", order == 1 ? " or mesh.order: 2" : "");
}

// Whether each corner of each cell lies on the surface, so that the body is one cell thick everywhere.
bool is_one_cell_thick(const Mesh& mesh) {
  std::vector<char> on_surface(mesh.nodes.size(), 0);
  for (const FaceCorners& face : boundary_faces(mesh))
    for (const int node : face) on_surface[static_cast<std::size_t>(node)] = 1;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (int a = 0; a < topology(mesh.cells.shape(c)).corners; ++a)
      if (!on_surface[static_cast<std::size_t>(mesh.cells[c][static_cast<std::size_t>(a)])]) return false;
  return true;
}

std::string one_layer(const Mesh& mesh) {
  if (mesh.order() == 1 || mesh.has_tets_only() || !is_one_cell_thick(mesh)) return "";
  return "the body is one cell thick, and stresses recovered from one layer of cells miss errors that all its cells "
         "share: the true error may be many times the estimate. Use two cells through the thickness, or check with "
         "orthodyn converge";
}

std::string stiff_law(const FemModel& model, bool by_finer_elements) {
  const int order = model.parts().mesh.order();
  for (const auto& term : model.parts().elastic) {
    const ElasticRegion& region = term->definition();
    const auto [ratio, volumetric] = region.mixed ? StiffnessContrast{contrast_without_bulk(region.softest()), false}
                                                  : stiffness_contrast(voigt(region.softest()));
    if (by_finer_elements && volumetric) continue;
    if (ratio < (volumetric ? stiff_volume(order) : stiff_direction(order))) continue;
    return fmt::format(
        "region '{}' is {:.0f} times as stiff {} as in its softest shear: all {} are then too stiff "
        "(locking), and the true error may be {} the estimate. {}, or check with orthodyn converge",
        term->region(), ratio, volumetric ? "against a change of volume" : "along its stiffest direction",
        order == 1 ? "linear elements" : topology(term->type().shape()).plural,
        by_finer_elements ? "two or three times" : "many times",
        volumetric && region.mixed_obstacle.empty() ? "Use formulation: mixed in this region"
        : order == 1                                ? "Use mesh.order: 2"
        : volumetric                                ? "Use a smaller nu if this one is not intended, finer cells"
                                                    : "Use finer cells");
  }
  return "";
}

}  // namespace

std::string locking_risk(const FemModel& model, const State& state, bool by_finer_elements) {
  std::string found = stiff_law(model, by_finer_elements);
  if (found.empty() && !by_finer_elements) found = flat_cells(model, state);
  if (found.empty() && !by_finer_elements) found = one_layer(model.parts().mesh);
  return found;
}

}  // namespace orthodyn
