#include "lib/fem/part_model.h"

#include <algorithm>
#include <cmath>

#include "lib/fem/on_all_ranks.h"

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

PartModel::PartModel(const FemModel& whole, const std::vector<std::string>& names)
    : whole_(whole), traits_(whole.traits()) {
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

void PartModel::force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const {
  const NodalExpansion nodal(whole_.parts(), t, q, v);
  whole_.parts().dofs->restrict_to(term_forces(whole_.parts(), nodal, terms_), f);
  if (mass_damping_) add_mass_damping(whole_.parts(), nodal, v, f);
  if (support_pull_) add_support_pull(whole_.parts(), nodal, f);
}

void PartModel::assemble(double t, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                         Linearization& out) const {
  const auto size = pattern().row.size();
  const bool damped = traits().damping_matrix;
  const NodalExpansion nodal(whole_.parts(), t, q, v);
  out.stiffness.assign(size, 0);
  if (damped) out.damping.assign(size, 0);
  on_all_ranks(whole_.parts().subdomain.get(), [&] {
    for (const Term* term : terms_)
      term->add_tangent(nodal.state(), kind, out.stiffness.data(), damped ? out.damping.data() : nullptr);
  });
}

void PartModel::assemble_mixed(double t_before, const ConstVectorRef& q_before, double t, const ConstVectorRef& q,
                               Linearization& out) const {
  const Vector still = Vector::Zero(q.size());
  const NodalExpansion before(whole_.parts(), t_before, q_before, still), nodal(whole_.parts(), t, q, still);
  out.stiffness.assign(pattern().row.size(), 0);
  on_all_ranks(whole_.parts().subdomain.get(), [&] {
    for (const Term* term : terms_) term->add_mixed_tangent(before.state(), nodal.state(), out.stiffness.data());
  });
}

// The whole model's, but for the mass damping that is not among these parts.
void PartModel::combine(const Weights& w, const Linearization& at, double* values) const {
  const auto& parts = whole_.parts();
  const double dropped = mass_damping_ ? 0 : w.damping * parts.mass_damping;
  whole_.combine({w.mass - dropped, w.damping, w.stiffness}, at, values);
}

double PartModel::frequency_bound() const {
  if (elastic_) return 0;
  const Mass& mass = *whole_.parts().mass;
  Vector row_sums = Vector::Zero(mass.nodal().size());
  for (const Term* term : terms_) term->add_stiffness_bound(row_sums);
  return std::sqrt(mass.frequency_excess() * largest_quotient(whole_.parts(), std::move(row_sums)));
}

std::vector<double> PartModel::breakpoints(double start, double end) const { return whole_.breakpoints(start, end); }

}  // namespace orthodyn
