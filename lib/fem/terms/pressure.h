// Follower pressure on a surface: the force -p n da on an area element da with normal n of a deformed face, or
//
//   f_a = -factor(t) integral of N_a p (x_,1 x x_,2) dL_1 dL_2
//
// with shape functions N_a, the derivatives x_,1 and x_,2 of the position with respect to the face's coordinates L_1
// and L_2, and the pressure p as a function of the rest position. The integral is exact for uniform pressure; see
// PressedFace.
//
// The work counts as work of a load, because only a closed surface under uniform pressure has an energy: p times the
// enclosed volume. -df_a/dx_b is symmetric if the pressure is uniform and the surface is closed or its edge is held
// (Hibbitt 1979, Some follower forces and load stiffness). Otherwise a symmetric pattern takes the symmetric part; the
// Newton matrix is then approximate, the force exact.
#pragma once

#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "lib/config/formula.h"
#include "lib/element/quad4.h"
#include "lib/element/quad8.h"
#include "lib/element/quad9.h"
#include "lib/element/tri3.h"
#include "lib/element/tri6.h"
#include "lib/fem/block_pattern.h"
#include "lib/fem/surface.h"
#include "lib/fem/term.h"
#include "lib/fem/time_functions/time_function.h"

namespace orthodyn {

// A face and its weights: the integrals of N_a p dL_1 dL_2 (Pa), divided among its tangent points.
template <Face F>
struct PressedFace {
  static constexpr std::size_t kCorners = F::kNodes == 3 || F::kNodes == 6 ? 3 : 4;
  std::array<int, F::kNodes> nodes;
  Eigen::Matrix<double, F::kNodes, F::kTangentPoints> weights;

  // p(X): pressure at the rest position (Pa), positive against the outward normal.
  PressedFace(std::span<const int> its_nodes, const FaceNodes<F>& X, const PointQuantity& p);

  // Nodal forces (N), one column per node, at positions x (m) of all nodes.
  FaceNodes<F> forces(const NodalVector& x) const;

  // -df/dx of the face's nodes, N/m.
  using Stiffness = Eigen::Matrix<double, 3 * F::kNodes, 3 * F::kNodes>;
  Stiffness stiffness(const NodalVector& x) const;
};

// The faces of a surface, by type.
class PressedFaces {
 public:
  // All faces of a surface. p: as for PressedFace.
  PressedFaces(const Mesh& mesh, const std::vector<FaceCorners>& faces, const PointQuantity& p);

  // Calls visit(face) for every face.
  template <class Visit>
  void for_each(Visit&& visit) const {
    const auto all_of = [&](const auto& list) {
      for (const auto& face : list) visit(face);
    };
    std::apply([&](const auto&... lists) { (all_of(lists), ...); }, lists_);
  }

  // The faces of a rank, in its node numbers.
  PressedFaces part(const Subdomain& subdomain) const;

  std::size_t bytes() const;

 private:
  PressedFaces() = default;

  template <Face F>
  using List = std::vector<PressedFace<F>>;
  std::tuple<List<Tri3>, List<Tri6>, List<Quad4>, List<Quad8>, List<Quad9>> lists_;
};

// Nodal forces (N) at positions x (m) of all nodes.
NodalForces pressure_forces(const PressedFaces& faces, const NodalVector& x);

// Whether the assembled stiffness at positions x (m) is symmetric to round-off in the coordinates that are not `held`
// (3 * node + component).
bool has_symmetric_stiffness(const PressedFaces& faces, const NodalVector& x, const std::vector<bool>& held);

class Pressure : public Term {
 public:
  // The pattern must outlive the term.
  Pressure(std::string surface, PressedFaces faces, std::shared_ptr<const TimeFunction> factor,
           const BlockPattern& pattern)
      : surface_(std::move(surface)), faces_(std::move(faces)), factor_(std::move(factor)), pattern_(pattern) {}

  std::string name() const override { return "pressure on " + surface_; }
  std::string description() const override { return name() + ": follows the surface"; }
  std::unique_ptr<Term> part(const Subdomain& subdomain) const override;
  std::size_t bytes() const override { return faces_.bytes(); }
  void add_force(const NodalState& s, NodalVector& f) const override;
  void add_peak_force(const NodalState& s, double end, NodalVector& f) const override;
  double seconds_at_peak(double start, double end) const override { return factor_->seconds_at_peak(start, end); }
  void add_tangent(const NodalState& s, TangentKind kind, double* stiffness, double* damping) const override;
  double load_power(const NodalState& s) const override;
  std::vector<double> breakpoints(double start, double end) const override;
  StepLimits step_limits(double start, double end) const override { return factor_->step_limits(start, end); }

 private:
  void add_force_of(double factor, const NodalVector& x, NodalVector& f) const;

  std::string surface_;
  PressedFaces faces_;
  std::shared_ptr<const TimeFunction> factor_;
  const BlockPattern& pattern_;
};

}  // namespace orthodyn
