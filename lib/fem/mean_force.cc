// The discrete gradient of a FemModel.
#include "lib/fem/fem_model.h"

namespace orthodyn {

namespace {

// Adds the velocity-dependent forces: the forces in the moving state minus those at zero velocity.
void add_damping(const FemModel::Parts& parts, const NodalState& moving, NodalVector& sum) {
  const NodalVector still = NodalVector::Zero(3, moving.x.cols());
  NodalVector without = NodalVector::Zero(3, moving.x.cols());
  for (const Term* term : all_terms(parts)) {
    term->add_force(moving, sum);
    term->add_force({moving.t, moving.x, moving.u, still}, without);
  }
  sum -= without;
}

class MeanForce : public DiscreteGradient {
 public:
  explicit MeanForce(const FemModel::Parts& parts) : parts_(parts) {}

  void mean_force(double t0, const ConstVectorRef& q0, double t1, const ConstVectorRef& q1, const ConstVectorRef& v,
                  VectorRef f) const override {
    const Vector still = Vector::Zero(q0.size());
    const NodalExpansion begin(parts_, t0, q0, still), end(parts_, t1, q1, still);
    NodalVector sum = NodalVector::Zero(3, begin.x.cols());
    for (const Term* term : all_terms(parts_)) term->add_mean_force(begin.state(), end.state(), sum);
    if (parts_.traits.damping_matrix) {
      const double t = 0.5 * (t0 + t1);
      const NodalVector x = 0.5 * (begin.x + end.x), u = 0.5 * (begin.u + end.u);
      const NodalVector rate = NodalExpansion(parts_, t, q0, v).u_rate;
      add_damping(parts_, {t, x, u, rate}, sum);
    }
    parts_.dofs->restrict_forces_to(sum, f);
    if (parts_.mass_damping != 0) add_mass_damping(parts_, begin, v, f);
  }

 private:
  const FemModel::Parts& parts_;
};

}  // namespace

std::unique_ptr<const DiscreteGradient> make_mean_force(const FemModel::Parts& parts) {
  return std::make_unique<MeanForce>(parts);
}

}  // namespace orthodyn
