#include "lib/fem/whole_fields.h"

#include <algorithm>

namespace orthodyn {

std::vector<double> on_all_nodes(const Subdomain& subdomain, const std::vector<double>& here, std::size_t components,
                                 std::size_t nodes) {
  std::vector<double> all(nodes * components, 0);
  for (int i = 0; i < subdomain.num_owned(); ++i) {
    const auto from = here.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(i) * components);
    const auto to = static_cast<std::size_t>(subdomain.nodes()[static_cast<std::size_t>(i)]) * components;
    std::copy_n(from, components, all.begin() + static_cast<std::ptrdiff_t>(to));
  }
  subdomain.ranks().sum(all);
  return all;
}

}  // namespace orthodyn
