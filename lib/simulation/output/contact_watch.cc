#include "lib/simulation/output/contact_watch.h"

namespace orthodyn {

void ContactWatch::observe(const ObservedState& observed) {
  for (std::size_t k = 0; k < names_.size(); ++k)
    if (touched_[k] == 0 && observed.evaluate("contact_pressure." + names_[k])[0] > 0) touched_[k] = 1;
}

ContactRecord ContactWatch::record() const {
  ContactRecord out{names_.size()};
  for (std::size_t k = 0; k < names_.size(); ++k)
    if (touched_[k] == 0) out.untouched.push_back(names_[k]);
  return out;
}

}  // namespace orthodyn
