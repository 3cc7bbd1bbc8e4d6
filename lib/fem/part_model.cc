// A FemModel restricted to some of its terms, with the same unknowns and mass. Splitting schemes use one PartModel for
// each part of the force.
#include <algorithm>
#include <cmath>

#include "lib/fem/fem_model.h"
#include "lib/ode/derived_model.h"

namespace orthodyn {

namespace {

const char* const kMassDamping = "mass damping";
const char* const kSupportPull = "pull of moved supports";

}  // namespace

std::vector<std::string> term_names(const std::vector<const Term*>& terms) {
  std::vector<std::string> names;
  for (const Term* term : terms) {
    const std::string base = term->name();
    std::string name = base;
    for (int k = 2; std::find(names.begin(), names.end(), name) != names.end(); ++k)
      name = base + " (" + std::to_string(k) + ")";
    names.push_back(name);
  }
  return names;
}

std::vector<std::string> part_names(const FemModel::Parts& parts) {
  auto names = term_names(all_terms(parts));
  if (parts.mass_damping > 0) names.push_back(kMassDamping);
  if (supports_pull(parts)) names.push_back(kSupportPull);
  return names;
}

namespace {

class PartModel : public DerivedModel {
 public:
  // `names` are names from part_names(). `whole` must outlive this object.
  PartModel(const FemModel& whole, const std::vector<std::string>& names)
      : DerivedModel(whole), whole_(whole), traits_(whole.traits()) {
    const auto terms = all_terms(whole.parts());
    const auto known = term_names(terms);
    const auto wanted = [&](const std::string& name) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    for (std::size_t k = 0; k < terms.size(); ++k)
      if (wanted(known[k])) terms_.push_back(terms[k]);
    elastic_ = std::any_of(known.begin(), known.begin() + static_cast<long>(whole.parts().elastic.size()), wanted);
    mass_damping_ = wanted(kMassDamping);
    support_pull_ = wanted(kSupportPull);
    const auto is_dead = [](const Term* term) { return term->is_dead(); };
    if (!mass_damping_ && std::all_of(terms_.begin(), terms_.end(), is_dead)) traits_.linear = true;
  }

  // Traits of the whole model; also linear if all parts are dead loads.
  const Traits& traits() const override { return traits_; }

  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override {
    const NodalExpansion nodal(whole_.parts(), t, q, v);
    whole_.parts().dofs->restrict_forces_to(term_forces(whole_.parts(), nodal, terms_), f);
    if (mass_damping_) add_mass_damping(whole_.parts(), nodal, v, f);
    if (support_pull_) add_support_pull(whole_.parts(), nodal, f);
  }

  // Like that of the whole model, but without mass damping if this is not among the parts.
  void combine(const Weights& w, const Linearization& at, double* values) const override {
    const auto& parts = whole_.parts();
    const double dropped = mass_damping_ ? 0 : w.damping * parts.mass_damping;
    whole_.combine({w.mass - dropped, w.damping, w.stiffness}, at, values);
  }

  // Bound from Term::add_stiffness_bound(); 0 (no bound) if elasticity is among the parts.
  double frequency_bound() const override {
    if (elastic_) return 0;
    const Mass& mass = *whole_.parts().mass;
    Vector row_sums = Vector::Zero(mass.nodal().size());
    for (const Term* term : terms_) term->add_stiffness_bound(row_sums);
    return std::sqrt(mass.frequency_excess() * largest_quotient(whole_.parts(), std::move(row_sums)));
  }

  std::vector<double> breakpoints(double start, double end) const override { return whole_.breakpoints(start, end); }
  StepLimits step_limits(double start, double end) const override { return whole_.step_limits(start, end); }

 private:
  void assemble(double t, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                Linearization& out) const override {
    term_tangents(whole_.parts(), NodalExpansion(whole_.parts(), t, q, v), terms_, kind, out);
  }

  void assemble_predicted(double t_before, const ConstVectorRef& q_before, double t, const ConstVectorRef& q,
                          Linearization& out) const override {
    const Vector still = Vector::Zero(q.size());
    const NodalExpansion before(whole_.parts(), t_before, q_before, still), nodal(whole_.parts(), t, q, still);
    term_predicted_tangents(whole_.parts(), before, nodal, terms_, out);
  }

  const FemModel& whole_;
  Traits traits_;
  std::vector<const Term*> terms_;
  bool elastic_ = false, mass_damping_ = false, support_pull_ = false;
};

}  // namespace

std::unique_ptr<Model> FemModel::only(const std::vector<std::string>& parts) const {
  return std::make_unique<PartModel>(*this, parts);
}

}  // namespace orthodyn
