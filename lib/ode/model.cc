#include "lib/ode/model.h"

#include <algorithm>
#include <atomic>
#include <stdexcept>

namespace orthodyn {

Model::Number::Number() {
  static std::atomic<std::uint64_t> last{0};
  value_ = ++last;
}

void Model::linearize(double t, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                      Linearization& out) const {
  const bool constant = traits().linear;
  const bool is_whole = out.stiffness.size() == pattern().row.size();  // false if moved from
  if (constant && is_whole && out.filled_by_ == number_.value()) return;
  out.filled_by_ = 0;  // in case assemble() throws
  out.damping.clear();
  assemble(t, q, v, kind, out);
  if (constant) out.filled_by_ = number_.value();
}

void Model::linearize_predicted(double t_before, const ConstVectorRef& q_before, double t, const ConstVectorRef& q,
                                Linearization& out) const {
  if (traits().linear) return linearize(t, q, Vector::Zero(q.size()), TangentKind::exact, out);
  out.filled_by_ = 0;
  out.damping.clear();
  assemble_predicted(t_before, q_before, t, q, out);
}

void Model::assemble_predicted(double, const ConstVectorRef&, double t, const ConstVectorRef& q,
                               Linearization& out) const {
  assemble(t, q, Vector::Zero(q.size()), TangentKind::exact, out);
}

std::unique_ptr<Model> Model::only(const std::vector<std::string>&) const {
  throw std::logic_error("the model's force has no parts");
}

std::vector<double> Model::breakpoints(double, double) const { return {}; }

std::unique_ptr<Model> without_loads(const Model& model) {
  const auto loads = model.load_parts();
  if (!loads) return nullptr;
  auto structure = model.force_parts();
  std::erase_if(structure, [&](const std::string& part) { return std::ranges::find(*loads, part) != loads->end(); });
  return model.only(structure);
}

}  // namespace orthodyn
