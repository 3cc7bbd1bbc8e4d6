#include "lib/simulation/modes/modal_analysis.h"

#include <algorithm>
#include <cmath>

#include "lib/analysis/rigid_freedom.h"
#include "lib/fem/element_mesh.h"
#include "lib/simulation/static_problem.h"

namespace orthodyn {

ModalAnalysis::ModalAnalysis(const Setup& setup, int count, bool about_equilibrium)
    : setup_(setup), scene_(setup.scene.is_static() ? setup.scene : at_rest(setup.scene)) {
  if (!setup.scene.is_static() && !scene_.motions.empty()) rebuilt_ = build(scene_);
  about_ = state_about(about_equilibrium);
  modes_ = natural_modes(model(), about_, count);
  // Only what the geometry leaves free is rigid; round-off makes zeros of the softest modes of slender bodies, too.
  if (modes_.zeros > 0) rigid_ = std::min(modes_.zeros, count_rigid_freedom(model(), about_.t));
  mesh_errors_ = find_mesh_errors();
}

namespace {

// Of each shape what the body's consistent mass makes of it: 1 less what lumping puts on top.
std::vector<double> consistent_masses(const FemModel::Parts& parts, const std::vector<NodalVector>& shapes) {
  const ElementMesh mesh(parts.mesh);
  std::vector<double> sums(shapes.size(), 0);
  for (std::size_t r = 0; r < parts.elastic.size(); ++r)
    for (const int cell : parts.elastic[r]->definition().cells) {
      const auto c = static_cast<std::size_t>(cell);
      const Eigen::MatrixXd M = mesh.type.consistent_mass(mesh.positions(c), parts.densities[r]);
      const auto nodes = mesh.cells[c];
      ElementType::Nodes at(3, M.cols());
      for (std::size_t k = 0; k < shapes.size(); ++k) {
        for (std::size_t a = 0; a < nodes.size(); ++a) at.col(static_cast<Eigen::Index>(a)) = shapes[k].col(nodes[a]);
        sums[k] += (at * M).cwiseProduct(at).sum();
      }
    }
  return sums;
}

}  // namespace

// A shape of unit modal mass has the elastic energy omega^2/2: what of it is error is the error of omega^2/2. A lumped
// mass adds to that the difference to the consistent one, whose own error is of higher order.
std::vector<double> ModalAnalysis::find_mesh_errors() const {
  const FemModel::Parts& parts = model().parts();
  const NodalExpansion about(parts, about_.t, about_.q, about_.v);
  std::vector<NodalVector> shapes;
  for (const Mode& mode : modes_.modes) {
    shapes.push_back(NodalVector::Zero(3, about.x.cols()));
    parts.dofs->add_to(mode.shape, shapes.back());
  }
  const auto masses = parts.mass->lumped() ? consistent_masses(parts, shapes) : std::vector<double>(shapes.size(), 1.0);
  std::vector<double> errors(shapes.size(), 0);
  for (auto k = static_cast<std::size_t>(modes_.zeros); k < errors.size(); ++k) {
    const StressMisfit misfit = parts.recovery->misfit_along(shapes[k], about.state());
    const double stiffness = parts.recovery->product(misfit, misfit) / std::abs(modes_.modes[k].lambda);
    errors[k] = (stiffness - (1 - masses[k])) / 2;
  }
  return errors;
}

State ModalAnalysis::state_about(bool equilibrium_asked) const {
  const Vector zero = Vector::Zero(model().num_dofs());
  const double t = scene_.time.end;
  if (!equilibrium_asked) return {t, zero, zero};
  if (scene_.start == Start::equilibrium) return {t, setup_.built.initial.q, zero};
  return {t, equilibrium(scene_, rebuilt_ ? *rebuilt_ : setup_.built), zero};
}

}  // namespace orthodyn
