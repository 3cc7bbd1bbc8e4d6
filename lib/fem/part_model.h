// Some of the terms of a FemModel on its unknowns and with its mass: what is left of the force when the
// others are dropped. A scheme that treats parts of the force differently takes one of these for each.
#pragma once

#include <string>
#include <vector>

#include "lib/fem/fem_model.h"

namespace orthodyn {

// A part has the name of its term ("elasticity of region wood", "traction on x1"), or is "mass damping" or "pull of
// moved supports". Of several with one name the second is "traction on x1 (2)".
std::vector<std::string> part_names(const FemModel::Parts& parts);

class PartModel : public Model {
 public:
  // The names are among part_names(); `whole` must outlive this.
  PartModel(const FemModel& whole, const std::vector<std::string>& names);

  int num_dofs() const override { return whole_.num_dofs(); }
  const Ranks* ranks() const override { return whole_.ranks(); }
  Eigen::Index num_dofs_of_all() const override { return whole_.num_dofs_of_all(); }
  Vector part_of(const Vector& all) const override { return whole_.part_of(all); }
  // The whole model's; dead loads alone are linear.
  const Traits& traits() const override { return traits_; }
  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override;
  const Pattern& pattern() const override { return whole_.pattern(); }
  void combine(const Weights& w, const Linearization& at, double* values) const override;
  void multiply_matrix(const double* values, const ConstVectorRef& x, VectorRef y) const override {
    whole_.multiply_matrix(values, x, y);
  }
  void multiply_mass(const ConstVectorRef& x, VectorRef y) const override { whole_.multiply_mass(x, y); }
  void solve_mass(VectorRef x) const override { whole_.solve_mass(x); }
  Eigen::MatrixXd rigid_motions(const ConstVectorRef& q) const override { return whole_.rigid_motions(q); }
  // Of terms that bound their own stiffness (Term::add_stiffness_bound); with elasticity among them none is at hand.
  double frequency_bound() const override;
  std::vector<double> breakpoints(double start, double end) const override;
  StepLimits step_limits(double start, double end) const override { return whole_.step_limits(start, end); }

 private:
  void assemble(double t, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                Linearization& out) const override;
  void assemble_mixed(double t_before, const ConstVectorRef& q_before, double t, const ConstVectorRef& q,
                      Linearization& out) const override;

  const FemModel& whole_;
  Traits traits_;
  std::vector<const Term*> terms_;
  bool elastic_ = false;
  bool mass_damping_ = false;
  bool support_pull_ = false;
};

}  // namespace orthodyn
