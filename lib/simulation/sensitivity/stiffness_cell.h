// A stiffness factor (lib/scene/stiffness_factors.h) as a parameter.
//
// The elastic force and energy of the elements in a cell of the grid are proportional to its factor s, so that
// df/ds = f_cell / s and dE/ds = E_cell / s, without changed models.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/fem/fem_model.h"
#include "lib/scene/scene.h"

namespace orthodyn {

class StiffnessCell {
 public:
  // The cell of the parameter at the path "regions.NAME.stiffness_factors.values.K"; empty for other paths. A cell
  // without elements has derivatives of 0. Preconditions: the scene has a number at the path; the model outlives the
  // result.
  static std::optional<StiffnessCell> find(const std::string& path, const Scene& scene, const FemModel& model);

  // Whether the path has this form.
  static bool is_path(const std::string& path);

  // Derivative of the force on the free coordinates, N.
  Vector force(const State& state) const;
  // The product of the derivative of the force with `weights` at the nodes. `work`: zeros at all nodes, before and
  // after. Costs one force of the cell's elements.
  double product(const NodalExpansion& nodal, const NodalVector& weights, NodalVector& work) const;
  // Derivative of the elastic energy, J.
  double energy(const State& state) const;

 private:
  StiffnessCell(const FemModel& model, std::vector<const Term*> terms, std::vector<int> nodes, double factor)
      : model_(&model), terms_(std::move(terms)), nodes_(std::move(nodes)), factor_(factor) {}

  const FemModel* model_;
  std::vector<const Term*> terms_;
  std::vector<int> nodes_;  // of the cell's elements
  double factor_;
};

}  // namespace orthodyn
