// Springs along their links, for any displacement: with span d, length l = |d|, free length l0 and direction n = d/l,
//   energy k (l - l0)^2/2,  force on node a -k (l - l0) n,
//   stiffness k n n^T + k (1 - l0/l) (I - n n^T),
// and between two states the force -k (1 - 2 l0/(l_0 + l_1)) (d_0 + d_1)/2, whose work is the change of the energy:
// the discrete derivative in l^2 (Gonzalez 1996).
// With the span D at rest, L = |D|, the elongation is l - l0 = (L - l0) + (2 D + u) . u / (L + l), in which small u
// keep their digits. A free length of zero makes the force -k d, linear and defined everywhere; else a spring that has
// shrunk to a point has no direction: RecoverableError.
#pragma once

#include <vector>

#include "lib/fem/term.h"
#include "lib/fem/terms/link.h"

namespace orthodyn {

struct SpringLink : Link {
  Vec3 at_rest = Vec3::Zero();  // the span in the rest shape, m
  double free_length = 0;       // without force, m
};

class Springs : public Term {
 public:
  // stiffness of each, N/m; the pattern must outlive the term and couple the ends.
  Springs(double stiffness, std::vector<SpringLink> links, const BlockPattern& pattern)
      : k_(stiffness), links_(std::move(links)), pattern_(pattern) {}

  std::string name() const override { return "springs"; }
  std::string description() const override;
  std::unique_ptr<Term> part(const Subdomain& subdomain) const override {
    return std::make_unique<Springs>(k_, owned_links(links_, subdomain), pattern_);
  }
  std::size_t bytes() const override { return links_.capacity() * sizeof(SpringLink); }
  void add_force(const NodalState& s, NodalVector& f) const override;
  void add_mean_force(const NodalState& s0, const NodalState& s1, NodalVector& f) const override;
  void add_tangent(const NodalState& s, TangentKind kind, double* stiffness, double* damping) const override;
  EnergyKind energy_kind() const override { return EnergyKind::elastic; }
  double energy(const NodalState& s) const override;
  void add_stiffness_bound(Vector& row_sums) const override;

 private:
  double k_;
  std::vector<SpringLink> links_;
  const BlockPattern& pattern_;
};

}  // namespace orthodyn
