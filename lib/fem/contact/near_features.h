// The places at which two surfaces, or parts of one surface, are closer than a gap, and whether surfaces cross.
//
// A point of a surface (face_middles.h) counts its distance from each triangle within the gap once. Triangles that
// share an edge or a corner repeat the distance from it, and these repetitions are subtracted. Beside a plane or convex
// surface, one distance is left, that from the nearest point; in a notch, both sides are left. The forces of sums over
// all places are continuous. Source: Li, Ferguson, Schneider, Langlois, Zorin, Panozzo, Jiang & Kaufman (2023),
// Convergent Incremental Potential Contact, arXiv 2307.15908. Each pair of edges counts once, sharp edges with a tenth
// of the area of their nodes.
#pragma once

#include <array>
#include <vector>

#include "lib/fem/contact/contact_surface.h"

namespace orthodyn {

struct NearPlace {
  std::array<int, 4> points;  // a point and the corners of a triangle, or the ends of two edges
  Distance distance;
  double area;          // m^2, negative for distances that are counted too often
  double parallel = 0;  // for edges: the sine of their angle, squared, times their squared lengths at rest, m^4,
                        // below which they count less. 0: not edges

  // Whether the energy of this place depends on the position of point k. That of two edges depends on all four ends,
  // through the angle of the edges.
  bool has_point(int k) const { return parallel > 0 || distance.has_point(k); }
};

// The surfaces must outlive this object, and may be the same one.
class NearFeatures {
 public:
  NearFeatures(const ContactSurface& first, const ContactSurface& second, double gap)
      : first_(first), second_(second), gap_(gap) {}

  // Throws RecoverableError if the surfaces cross at the positions x: if an edge passes through a triangle, or a node
  // is less than half a cell below the other surface, away from its boundary.
  std::vector<NearPlace> at(const NodalVector& x) const;

 private:
  bool is_one() const { return &first_ == &second_; }

  const ContactSurface &first_, &second_;
  double gap_;  // m
};

}  // namespace orthodyn
