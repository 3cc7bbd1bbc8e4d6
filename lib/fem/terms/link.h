// A connection of a node with another node or with a point of the ground, and how a force along it and its
// derivative enter the nodal forces and the matrix.
#pragma once

#include <vector>

#include "lib/fem/block_pattern.h"
#include "lib/fem/subdomain.h"

namespace orthodyn {

struct Link {
  int a = 0;
  int b = -1;                  // -1: the ground
  Vec3 anchor = Vec3::Zero();  // m; of the ground

  // From the other end to node a, m; and how it changes by displacements u, m, or velocities, m/s.
  Vec3 span(const NodalVector& x) const { return x.col(a) - (b < 0 ? anchor : Vec3(x.col(b))); }
  Vec3 change(const NodalVector& u) const { return b < 0 ? Vec3(u.col(a)) : Vec3(u.col(a) - u.col(b)); }

  // `force` on node a, its opposite on the other end.
  void add_force(const Vec3& force, NodalVector& f) const {
    f.col(a) += force;
    if (b >= 0) f.col(b) -= force;
  }

  // The symmetric -d force/d span: blocks +, +, -, -.
  void add_block(const Mat3& block, const BlockPattern& pattern, double* values) const {
    pattern.add(a, a, pattern.offset(a, a), block, values);
    if (b < 0) return;
    pattern.add(b, b, pattern.offset(b, b), block, values);
    if (!pattern.symmetric() || a > b) pattern.add(a, b, pattern.offset(a, b), -block, values);
    if (!pattern.symmetric() || b > a) pattern.add(b, a, pattern.offset(b, a), -block, values);
  }

  // Adds to each node the row sum of the matrix that belongs to a stiffness k, N/m.
  void add_row_sum(double k, Vector& sums) const {
    sums[a] += b < 0 ? k : 2 * k;
    if (b >= 0) sums[b] += 2 * k;
  }
};

// Those whose node a this rank owns, by the numbers of nodes here.
template <class L>
std::vector<L> owned_links(const std::vector<L>& links, const Subdomain& subdomain) {
  std::vector<L> own;
  for (L link : links) {
    if (!subdomain.owns(link.a)) continue;
    link.a = subdomain.local(link.a);
    if (link.b >= 0) link.b = subdomain.local(link.b);
    own.push_back(link);
  }
  return own;
}

}  // namespace orthodyn
