// A rigid plane that pushes back nodes that are below it. With the depth d = (point - x) . n of a node and its
// share A of the surface, the energy k A psi(d) is twice continuously differentiable:
//   psi'(d) = 0 for d <= 0,  d^2/(2 w) for d < w,  d - w/2 beyond;
// force k A psi'(d) n, stiffness k A psi''(d) n n^T; between two states psi' is its mean over the depths passed.
// w is the depth over which contact sets in. Neither friction nor damping: the plane gives back all energy.
#pragma once

#include <vector>

#include "lib/fem/block_pattern.h"
#include "lib/fem/term.h"

namespace orthodyn {

struct GroundPlane {
  Vec3 point = Vec3::Zero(), normal{0, 0, 1};  // m; of unit length, away from the ground
  double stiffness = 0;                        // Pa/m
  double onset = 0;                            // w, m
};

class GroundContact : public Term {
 public:
  // node and its share of the surface, m^2; the pattern must outlive the term.
  GroundContact(const GroundPlane& plane, std::vector<std::pair<int, double>> areas, const BlockPattern& pattern)
      : plane_(plane), areas_(std::move(areas)), pattern_(pattern) {}

  std::string name() const override { return "ground contact"; }
  std::string description() const override;
  std::unique_ptr<Term> part(const Subdomain& subdomain) const override {
    return std::make_unique<GroundContact>(plane_, subdomain.owned(areas_), pattern_);
  }
  std::size_t bytes() const override { return areas_.capacity() * sizeof(areas_[0]); }
  void add_force(const NodalState& s, NodalVector& f) const override;
  void add_mean_force(const NodalState& s0, const NodalState& s1, NodalVector& f) const override;
  void add_tangent(const NodalState& s, TangentKind kind, double* stiffness, double* damping) const override;
  EnergyKind energy_kind() const override { return EnergyKind::elastic; }
  double energy(const NodalState& s) const override;
  void add_stiffness_bound(Vector& row_sums) const override;
  double contact_stiffness() const override;

 private:
  double depth(int node, const NodalVector& x) const { return plane_.normal.dot(plane_.point - x.col(node)); }

  GroundPlane plane_;
  std::vector<std::pair<int, double>> areas_;
  const BlockPattern& pattern_;
};

}  // namespace orthodyn
