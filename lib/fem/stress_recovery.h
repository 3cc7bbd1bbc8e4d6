// What is recovered at the nodes of a model's elastic terms, and the error of its mesh that the difference of recovered
// and computed stresses, the misfit, tells.
//
// Regions are recovered one by one, for stresses jump between them. Thread-safe: computed once, at the first use.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "lib/fem/misfit_energy.h"
#include "lib/fem/region_recovery.h"
#include "lib/fem/terms/elastic_term.h"

namespace orthodyn {

// Recovered less computed stress in the axes of space at rest, Pa: of each term's region a row for each node of each of
// its elements, on all ranks. Of a derivative along a displacement, Pa/m.
using StressMisfit = std::vector<SixColumns>;

class StressRecovery {
 public:
  using Terms = std::vector<std::unique_ptr<ElasticTerm>>;

  // All must outlive it. Where several ranks have parts of the terms, `mesh` is the whole one, and what is computed at
  // their points comes from all: functions are collective, states are of the subdomain.
  StressRecovery(const TetMesh& mesh, const Terms& terms, const Subdomain* subdomain)
      : mesh_(mesh), terms_(terms), subdomain_(subdomain) {}

  std::size_t num_nodes() const { return mesh_.nodes.size(); }
  std::size_t num_regions() const { return terms_.size(); }

  // Of what is seen at the points, six components, in one term's region by itself: its nodes, and a row for each. Valid
  // as long as this.
  using Seen = std::function<Vec6(const PointObservation&)>;
  struct OfRegion {
    const std::vector<int>* nodes;
    SixColumns values;
  };
  OfRegion at_nodes_of_region(std::size_t region, const NodalState& s, const Seen& seen) const;

  // One for each term, of its elements on this rank.
  std::vector<RegionMeshError> mesh_errors(const NodalState& s) const;

  // Of the stress in a state, and of its derivative along a displacement from there.
  StressMisfit misfit(const NodalState& s) const;
  StressMisfit misfit_along(const NodalVector& direction, const NodalState& s) const;
  // The integral of a : C^-1 : b over the body: what the energy of a and b together is above that of each, J.
  double product(const StressMisfit& a, const StressMisfit& b) const;

 private:
  // The elements of a region on all ranks.
  struct Region {
    RegionRecovery recovery;
    std::vector<int> places;  // among these of the term's elements
  };

  StressMisfit misfit_of(const std::vector<SixColumns>& at_points) const;
  const std::vector<Region>& regions() const;
  Region make_region(const ElementMesh& mesh, const ElasticTerm& term) const;
  SixColumns of_all_ranks(std::size_t region, SixColumns at_points) const;

  const TetMesh& mesh_;
  const Terms& terms_;
  const Subdomain* subdomain_;
  mutable std::once_flag once_;
  mutable std::vector<Region> regions_;
};

}  // namespace orthodyn
