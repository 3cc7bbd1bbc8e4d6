// The tie of two surfaces whose meshes need not match, by the mortar method with dual multipliers. The displacement
// of the first surface is the projection of the displacement of the second one. The projection reproduces linear
// fields: constant stresses pass exactly through plane surfaces whose faces have straight edges (patch test). Sources:
// Wohlmuth, SIAM J. Numer. Anal. 38, 2000 (dual multipliers); Puso, IJNME 59, 2004 (surfaces in space); Popp, Wohlmuth,
// Gee & Wall, SIAM J. Sci. Comput. 34, 2012 (quadratic faces).
#pragma once

#include <optional>
#include <vector>

#include "lib/fem/ties/ties.h"
#include "lib/mesh/mesh.h"

namespace orthodyn {

struct Mortar {
  std::vector<TiedNode> nodes;  // of the first surface; without the nodes in no_counterpart
  std::vector<int> no_counterpart;
  double uncovered = 0;  // share of the area of the first surface that has no counterpart
  double gap = 0;        // largest distance of the surfaces, m
};

// Faces belong together if they face each other at a distance of at most `reach` (m); by default a tenth of the size of
// each face.
Mortar tie_surfaces(const Mesh& mesh, const std::vector<FaceCorners>& first, const std::vector<FaceCorners>& second,
                    std::optional<double> reach);

// Moves tied nodes to the place of their leaders' mean, so that rigid motions of the leaders move them rigidly. Returns
// the largest change of a place, m.
double move_to_leaders(Mesh& mesh, const Ties& ties);

}  // namespace orthodyn
