// The misfit of a region's stresses, recovered less computed, at the nodes of its elements, and its elastic energy: by
// that the error of the mesh is estimated (Zienkiewicz & Zhu 1992).
#pragma once

#include <vector>

#include "lib/fem/region_recovery.h"
#include "lib/fem/terms/elastic_term.h"

namespace orthodyn {

// Of a term's elements on this rank, in their order.
struct RegionMeshError {
  Vector volume;  // m^3
  Vector error;   // J, elastic energy of the error that the mesh makes
  double energy;  // J, of the computed stresses in all of them
};

// Stresses are in the axes of space at rest, Pa; `computed` ones are given at the points of the region.

// A row for each node of each of its elements.
SixColumns misfit_of_region(const ElementMesh& mesh, const RegionRecovery& recovery, const SixColumns& computed);

// Of a term, whose elements are those of the region at `places`.
RegionMeshError mesh_error(const ElementMesh& mesh, const ElasticTerm& term, const RegionRecovery& recovery,
                           const std::vector<int>& places, const SixColumns& computed);

// The integral of a : C^-1 : b over the term's elements, J; a, b: misfits of the region.
double misfit_product(const ElementMesh& mesh, const ElasticTerm& term, const std::vector<int>& places,
                      const SixColumns& a, const SixColumns& b);

}  // namespace orthodyn
