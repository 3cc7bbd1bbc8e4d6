// Stresses and strains recovered at the nodes, and the discretisation error estimated from the misfit of recovered and
// computed stresses.
//
// Each region is recovered separately, because stresses jump between regions. Thread-safe. The patches are set up at
// the first use.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "lib/fem/region_recovery.h"
#include "lib/fem/terms/elastic_term.h"

namespace orthodyn {

// Error estimate for the elements of a term on this rank, one entry per element, in the term's order.
struct RegionMeshError {
  Vector volume;  // m^3
  Vector error;   // elastic energy of the error, J
  double energy;  // elastic energy of the computed stresses, summed over the elements, J
};

// Recovered minus computed stress in space axes at rest, Pa (for derivatives along a displacement: Pa/m). There is one
// entry per term, with one row for each node of each element on all ranks.
using StressMisfit = std::vector<SixColumns>;

class StressRecovery {
 public:
  using Terms = std::vector<std::unique_ptr<ElasticTerm>>;

  // All arguments must outlive this object. With several ranks, `mesh` is the whole mesh, states belong to the
  // subdomain, and all ranks must call each function together.
  StressRecovery(const Mesh& mesh, const Terms& terms, const Subdomain* subdomain)
      : mesh_(mesh), terms_(terms), subdomain_(subdomain) {}

  std::size_t num_nodes() const { return mesh_.nodes.size(); }
  std::size_t num_regions() const { return terms_.size(); }

  // Recovers six components of a point observation in the region of one term. `nodes` and `inside` point into this
  // object.
  using Pick = std::function<Vec6(const PointObservation&)>;
  struct NodalValues {
    const std::vector<int>* nodes;    // indices in the mesh
    const std::vector<char>* inside;  // whether the node lies in the term's part of its cells: RegionRecovery::inside()
    SixColumns values;                // one row per node
  };
  NodalValues at_nodes_of_region(std::size_t region, const NodalState& s, const Pick& pick) const;

  // The values of at_nodes_of_region() at one node of the mesh, from the elements around it; empty if the node is not
  // in the region. Precondition: one rank.
  struct NodalValue {
    Vec6 value;
    bool inside;
  };
  std::optional<NodalValue> at_node_of_region(std::size_t region, int node, const NodalState& s,
                                              const Pick& pick) const;
  bool has_ranks() const { return subdomain_ != nullptr; }

  // Error estimates of all terms, for their elements on this rank.
  std::vector<RegionMeshError> mesh_errors(const NodalState& s) const;

  // Misfit of the stress in a state, and the derivative of the misfit along a nodal displacement `direction`.
  StressMisfit misfit(const NodalState& s) const;
  StressMisfit misfit_along(const NodalVector& direction, const NodalState& s) const;
  // Integral of a : C^-1 : b over the body (J), with the stiffness C.
  double product(const StressMisfit& a, const StressMisfit& b) const;

 private:
  // A term's region with its elements on all ranks.
  struct Region {
    RegionRecovery recovery;
    std::vector<int> places;  // index of each of the term's elements in the region
  };

  StressMisfit misfit_of(const std::vector<SixColumns>& at_points) const;
  const std::vector<Region>& regions() const;
  Region make_region(const ElementMesh& mesh, const ElasticTerm& term) const;
  SixColumns of_all_ranks(std::size_t region, SixColumns at_points) const;

  const Mesh& mesh_;
  const Terms& terms_;
  const Subdomain* subdomain_;
  mutable std::once_flag once_;
  mutable std::vector<Region> regions_;
};

// Implementation (misfit_energy.cc). The misfit of a region, recovered minus computed, is given at the nodes of its
// elements. Its elastic energy estimates the discretisation error (Zienkiewicz & Zhu 1992).
//
// In the following, stresses (Pa) are in space axes at rest, and `computed` has one row per integration point of the
// region. `places`: index of each of the term's elements in the region.

// Recovered minus computed stress: one row per node of each element.
SixColumns misfit_of_region(const ElementType& type, const RegionRecovery& recovery, const SixColumns& computed);

RegionMeshError mesh_error(const ElementMesh& mesh, const ElasticTerm& term, const RegionRecovery& recovery,
                           const std::vector<int>& places, const SixColumns& computed);

// Integral of a : C^-1 : b over the term's elements, J. a and b are results of misfit_of_region().
double misfit_product(const ElementMesh& mesh, const ElasticTerm& term, const std::vector<int>& places,
                      const SixColumns& a, const SixColumns& b);

}  // namespace orthodyn
