#include "lib/ode/load_path.h"

#include "lib/core/errors.h"

namespace orthodyn {

LoadPath::LoadPath(const Model& model, double t, Vector start)
    : model_(model), t_(t), start_(std::move(start)), load_(start_.size()) {
  try {
    model.force(t, start_, Vector::Zero(start_.size()), load_);
  } catch (const RecoverableError& e) {
    throw RunError(std::string("the forces cannot be evaluated at the start: ") + e.what(), Reason::force);
  }
  if (!load_.allFinite()) throw RunError("the forces at the start are not finite; check the loads", Reason::force);
}

void LoadPath::force(double lambda, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const {
  model_.force(t_, q, v, f);
  f -= (1 - lambda) * load_;
}

}  // namespace orthodyn
