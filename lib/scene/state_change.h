// The sections `moisture` and `temperature`: the change of a field that makes materials swell or shrink
// (lib/material/expansion.h), counted from the stress-free state.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/config/formula.h"
#include "lib/config/spec.h"
#include "lib/fem/added_laws/point_values.h"
#include "lib/fem/element_mesh.h"
#include "lib/fem/element_type.h"

namespace orthodyn {

struct StateChange {
  std::optional<PointQuantity> change;      // per cent or K
  std::optional<TimePointFormula> formula;  // instead of `change` and `factor`
  std::optional<FilePath> file;             // instead of `change`: values at the nodes
  std::shared_ptr<const TimeFunction> factor;
  std::vector<double> kinks;  // s, of `formula`
  SourceLocation origin;
  std::string quantity = "change";  // the key of `change`, and the column of the file
  static const Spec<StateChange>& spec();

  void check(const Config& config) const;  // throws ConfigError for keys that exclude each other
  bool constant() const { return formula ? !formula->uses("t") : factor->constant(); }

  // `of_all_ranks`: the elements of the part on all ranks, at some of which step limits are found.
  // The values at the integration points of the elements `cells` of one type; `mesh` is the whole mesh. `start` and
  // `end` of the time span (s). Throws ConfigError if the file does not fit the mesh.
  std::unique_ptr<PointValues> at_points(const ElementType& type, const ElementMesh& mesh,
                                         const std::vector<int>& cells, const std::vector<int>& of_all_ranks,
                                         double start, double end) const;
};

}  // namespace orthodyn
