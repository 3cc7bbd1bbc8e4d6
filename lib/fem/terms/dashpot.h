// Dashpots: a force against the rate of their links. Along the link, with its direction n as it is now,
//   force on node a -c n (n . d'),  power c (n . d')^2,  damping matrix c n n^T;
// or, for a node that is tied to its own place, against all motion: -c d', c |d'|^2, c I.
// The change of n with position is left out of K: the Newton matrix is approximate, the force exact. A link
// of length zero has no direction: RecoverableError.
#pragma once

#include <vector>

#include "lib/fem/term.h"
#include "lib/fem/terms/link.h"

namespace orthodyn {

enum class DashpotLaw { along, all_directions };

class Dashpots : public Term {
 public:
  // coefficient of each, N s/m; the pattern must outlive the term and couple the ends.
  Dashpots(double coefficient, DashpotLaw law, std::vector<Link> links, const BlockPattern& pattern)
      : c_(coefficient), law_(law), links_(std::move(links)), pattern_(pattern) {}

  std::string name() const override { return "dashpots"; }
  std::string description() const override;
  std::unique_ptr<Term> part(const Subdomain& subdomain) const override {
    return std::make_unique<Dashpots>(c_, law_, owned_links(links_, subdomain), pattern_);
  }
  std::size_t bytes() const override { return links_.capacity() * sizeof(Link); }
  void add_force(const NodalState& s, NodalVector& f) const override;
  void add_tangent(const NodalState& s, TangentKind kind, double* stiffness, double* damping) const override;
  double dissipation(const NodalState& s) const override;

 private:
  Mat3 matrix(const Link& link, const NodalVector& x) const;  // N s/m

  double c_;
  DashpotLaw law_;
  std::vector<Link> links_;
  const BlockPattern& pattern_;
};

}  // namespace orthodyn
