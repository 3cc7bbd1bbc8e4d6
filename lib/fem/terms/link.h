// A connection of a node with another node or with a fixed point, and the assembly of its force and stiffness.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "lib/fem/block_pattern.h"
#include "lib/fem/subdomain.h"
#include "lib/mesh/selection.h"

namespace orthodyn {

struct Link {
  int a = 0;
  int b = -1;                  // -1: the ground
  Vec3 anchor = Vec3::Zero();  // m; used if b is -1

  // Vector from the other end to node a (m), and the change of this vector for displacements (m), or its rate for
  // velocities (m/s).
  Vec3 span(const NodalVector& x) const { return x.col(a) - (b < 0 ? anchor : Vec3(x.col(b))); }
  Vec3 change(const NodalVector& u) const { return b < 0 ? Vec3(u.col(a)) : Vec3(u.col(a) - u.col(b)); }

  // Adds `force` to node a and its opposite to the other end.
  void add_force(const Vec3& force, NodalVector& f) const {
    f.col(a) += force;
    if (b >= 0) f.col(b) -= force;
  }

  // Adds the symmetric matrix `block` = -d force / d span, with sign + to the diagonal blocks and - to the others.
  void add_block(const Mat3& block, const BlockPattern& pattern, double* values) const {
    pattern.add(a, a, pattern.offset(a, a), block, values);
    if (b < 0) return;
    pattern.add(b, b, pattern.offset(b, b), block, values);
    if (!pattern.symmetric() || a > b) pattern.add(a, b, pattern.offset(a, b), -block, values);
    if (!pattern.symmetric() || b > a) pattern.add(b, a, pattern.offset(b, a), -block, values);
  }

  // Adds the bounds of Term::add_stiffness_bound() for a spring of stiffness k (N/m).
  void add_row_sum(double k, Vector& sums) const {
    sums[a] += b < 0 ? k : 2 * k;
    if (b >= 0) sums[b] += 2 * k;
  }
};

// The links whose node a this rank owns, in local node numbers.
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

// Input of springs and dashpots: two nodes, or selected nodes that are tied to the ground.
struct Ends : Selection {
  std::optional<std::array<Vec3, 2>> between;  // m; the nodes nearest to two points
  std::optional<Vec3> anchor;                  // m; default: each node's own rest position

  // Whether each node is tied to its own rest position by a link of length zero.
  bool in_place() const { return !between && !anchor; }
  // The links of the body; at least one.
  std::vector<Link> links(const Mesh& mesh) const;
  NodePairs couplings(const Mesh& mesh) const;
  void check(const Config& config) const;
};

template <class T>
Spec<T> ends_spec() {
  return selection_spec<T>()
      .key("between", &T::between, "In place of selected nodes: the two nodes nearest to these points.", {.unit = "m"})
      .key("anchor", &T::anchor, "Fixed point that selected nodes are tied to; default: each node's own rest position.",
           {.unit = "m"});
}

}  // namespace orthodyn
