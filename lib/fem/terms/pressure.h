// Follower pressure on a surface: the virtual work of -p n da, with the normal n and the area of the deformed faces,
//
//   f_a = -factor(t) integral of N_a p (x_,1 x x_,2) dL_1 dL_2
//
// with the tangents x_,1 and x_,2 of a face and p at rest. Exact for a uniform pressure; see PressedFace.
//
// A surface without boundary under uniform pressure has the energy p V; the force of others has none, so its work
// counts as that of a load. The derivative -df_a/dx_b is symmetric where the pressure is uniform on a closed surface,
// or on one whose edge is held (Hibbitt 1979, Some follower forces and load stiffness). Elsewhere a symmetric pattern
// takes its symmetric part: an approximate Newton matrix, an exact force.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lib/config/point_quantity.h"
#include "lib/element/face.h"
#include "lib/fem/block_pattern.h"
#include "lib/fem/term.h"
#include "lib/fem/time_functions/time_function.h"

namespace orthodyn {

// A face with the integrals of N_a p about each point where its tangents are taken, Pa per unit of L_1 and L_2.
template <Face F>
struct PressedFace {
  std::array<int, F::kNodes> nodes;
  Eigen::Matrix<double, F::kNodes, F::kTangentPoints> weights;

  // `p` of the rest position, Pa; positive where it pushes against the outward normal.
  PressedFace(std::span<const int> its_nodes, const FaceNodes<F>& X, const PointQuantity& p);

  // A column per node, at positions x (m) of all nodes, N.
  FaceNodes<F> forces(const NodalVector& x) const;

  // -df/dx by its nodes' coordinates, N/m.
  using Stiffness = Eigen::Matrix<double, 3 * F::kNodes, 3 * F::kNodes>;
  Stiffness stiffness(const NodalVector& x) const;
};

// Whether their stiffnesses at positions x (m) make up a symmetric one of a body that is held in these coordinates
// (3 node + component), to round-off.
template <Face F>
bool has_symmetric_stiffness(const std::vector<PressedFace<F>>& faces, const NodalVector& x,
                             const std::vector<bool>& held);

template <Face F>
class Pressure : public Term {
 public:
  // The pattern must outlive the term.
  Pressure(std::string surface, std::vector<PressedFace<F>> faces, std::shared_ptr<const TimeFunction> factor,
           const BlockPattern& pattern)
      : surface_(std::move(surface)), faces_(std::move(faces)), factor_(std::move(factor)), pattern_(pattern) {}

  std::string name() const override { return "pressure on " + surface_; }
  std::string description() const override { return name() + ": follows the surface"; }
  std::unique_ptr<Term> part(const Subdomain& subdomain) const override;
  std::size_t bytes() const override { return faces_.capacity() * sizeof(PressedFace<F>); }
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
  std::vector<PressedFace<F>> faces_;
  std::shared_ptr<const TimeFunction> factor_;
  const BlockPattern& pattern_;
};

}  // namespace orthodyn
