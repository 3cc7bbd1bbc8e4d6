#include "lib/simulation/output/contact_watch.h"

#include "lib/fem/contact/contact.h"

namespace orthodyn {

std::vector<double> ContactWatch::acted() const {
  std::vector<double> out = before_;
  for (std::size_t k = 0; k < out.size(); ++k)
    if (model_.space().any(out[k] > 0 || model_.parts().contacts[k].contact->has_acted())) out[k] = 1;
  return out;
}

ContactRecord ContactWatch::record() const {
  const std::vector<double> acted = this->acted();
  ContactRecord out{acted.size()};
  for (std::size_t k = 0; k < acted.size(); ++k)
    if (acted[k] == 0) out.untouched.push_back(model_.parts().contacts[k].name);
  return out;
}

}  // namespace orthodyn
