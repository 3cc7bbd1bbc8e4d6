#include "lib/fem/pattern_share.h"

#include <algorithm>

namespace orthodyn {

namespace {

bool has_unknown(const std::array<int, 3>& dofs) { return *std::max_element(dofs.begin(), dofs.end()) >= 0; }

}  // namespace

PatternShare share_of(const DofMap& dofs, const Subdomain& subdomain) {
  const Ranks& ranks = subdomain.ranks();
  PatternShare share{&ranks, dofs.num_dofs(), 0, 0, {}, 0};
  for (int i = 0; i < dofs.num_owned_nodes(); ++i)
    if (has_unknown(dofs.node(i))) ++share.owned_points;
  share.first_point = ranks.sum_before(share.owned_points);
  share.unknowns = static_cast<std::int64_t>(ranks.sum(share.owned));

  NodalVector numbers = NodalVector::Zero(3, dofs.num_nodes());  // whole numbers, which doubles hold up to 2^53
  auto next = static_cast<double>(share.first_point);
  for (int i = 0; i < dofs.num_owned_nodes(); ++i)
    if (has_unknown(dofs.node(i))) numbers(0, i) = next++;
  subdomain.copy_from_owners(numbers);
  share.row.reserve(static_cast<std::size_t>(dofs.num_dofs_here()));
  for (int i = 0; i < dofs.num_nodes(); ++i)
    for (int c = 0; c < 3; ++c)
      if (dofs.node(i)[static_cast<std::size_t>(c)] >= 0)
        share.row.push_back(3 * static_cast<std::int64_t>(numbers(0, i)) + c);
  return share;
}

}  // namespace orthodyn
