// The internal variables of a FemModel: those of its added terms, one term after the other.
#include "lib/ode/internal_variables.h"

#include <vector>

#include "lib/fem/fem_model.h"
#include "lib/fem/terms/added_term.h"

namespace orthodyn {

namespace {

class FemInternalVariables final : public InternalVariables {
 public:
  FemInternalVariables(const FemModel::Parts& parts, std::vector<const AddedTerm*> terms, Eigen::Index size)
      : parts_(parts), terms_(std::move(terms)), times_(size), extent_(bounding_box(parts.mesh).size().maxCoeff()) {
    for (const AddedTerm* term : terms_) term->get_relaxation_times(times_);
  }

  Eigen::Index size() const override { return times_.size(); }
  const Vector& relaxation_times() const override { return times_; }
  double strain_of(double position) const override { return position / extent_; }

  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, const InternalState& z,
             VectorRef f) const override {
    const NodalExpansion nodal = expansion(t, q, v, &z);
    free_forces(parts_, nodal, v, term_forces(parts_, nodal), f);
  }
  void assemble(double t, const ConstVectorRef& q, const ConstVectorRef& v, const InternalState& z, TangentKind kind,
                Linearization& out) const override {
    term_tangents(parts_, expansion(t, q, v, &z), all_terms(parts_), kind, out);
  }

  void add_peak_force(double start, double end, VectorRef f) const override {
    const Vector rest = Vector::Zero(f.size());
    const NodalExpansion nodal = expansion(start, rest, rest, nullptr);
    NodalVector sum = NodalVector::Zero(3, nodal.x.cols());
    for (const AddedTerm* term : terms_) term->add_internal_peak_force(nodal.state(), end, sum);
    Vector free(f.size());
    parts_.dofs->restrict_forces_to(sum, free);
    f += free;
  }

  void strains(double t, const ConstVectorRef& q, VectorRef e) const override {
    const NodalExpansion nodal = expansion(t, q, Vector::Zero(q.size()), nullptr);
    for (const AddedTerm* term : terms_) term->get_strains(nodal.state(), e);
  }
  void total_strains(double t, const ConstVectorRef& q, VectorRef e) const override {
    const NodalExpansion nodal = expansion(t, q, Vector::Zero(q.size()), nullptr);
    for (const AddedTerm* term : terms_) term->get_total_strains(nodal.state(), e);
  }
  void strain_change(double t, const ConstVectorRef& q, const ConstVectorRef& dq, VectorRef de) const override {
    const NodalExpansion nodal = expansion(t, q, Vector::Zero(q.size()), nullptr);
    NodalVector du = NodalVector::Zero(3, nodal.x.cols());
    parts_.dofs->add_to(dq, du);
    for (const AddedTerm* term : terms_) term->get_strain_change(nodal.state(), du, de);
  }
  void force_change(double t, const ConstVectorRef& q, const Vector& dz, VectorRef df) const override {
    const NodalExpansion nodal = expansion(t, q, Vector::Zero(q.size()), nullptr);
    NodalVector sum = NodalVector::Zero(3, nodal.x.cols());
    for (const AddedTerm* term : terms_) term->add_force_change(nodal.state(), dz, sum);
    parts_.dofs->restrict_forces_to(sum, df);
  }

 private:
  NodalExpansion expansion(double t, const ConstVectorRef& q, const ConstVectorRef& v, const InternalState* z) const {
    NodalExpansion nodal(parts_, t, q, v);
    nodal.internal = z;
    return nodal;
  }

  const FemModel::Parts& parts_;
  std::vector<const AddedTerm*> terms_;
  Vector times_;
  double extent_;
};

}  // namespace

std::unique_ptr<const InternalVariables> make_internal_variables(FemModel::Parts& parts) {
  std::vector<const AddedTerm*> terms;
  Eigen::Index size = 0;
  for (const auto& load : parts.loads)
    if (auto* term = dynamic_cast<AddedTerm*>(load.get()); term && term->num_internal() > 0) {
      term->set_first_internal(size);
      size += term->num_internal();
      terms.push_back(term);
    }
  if (terms.empty()) return nullptr;
  return std::make_unique<FemInternalVariables>(parts, std::move(terms), size);
}

}  // namespace orthodyn
