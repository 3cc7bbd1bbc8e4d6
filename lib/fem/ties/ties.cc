#include "lib/fem/ties/ties.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "lib/core/errors.h"

namespace orthodyn {

double TiedNode::sum_of_magnitudes() const {
  double sum = 0;
  for (const auto& [leader, weight] : leaders) sum += std::abs(weight);
  return sum;
}

Ties::Ties(int num_nodes, std::vector<TiedNode> nodes)
    : nodes_(std::move(nodes)), index_(static_cast<std::size_t>(num_nodes), -1) {
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    index_[static_cast<std::size_t>(nodes_[k].node)] = static_cast<int>(k);
  enum class Progress { open, begun, resolved };
  std::vector<Progress> states(nodes_.size(), Progress::open);
  const std::function<void(std::size_t)> resolve = [&](std::size_t k) {
    if (states[k] == Progress::resolved) return;
    if (states[k] == Progress::begun)
      throw ConfigError("ties",
                        "surfaces follow each other in a circle; let each tie start at a surface that follows none");
    states[k] = Progress::begun;
    std::map<int, double> sums;
    for (const auto& [leader, weight] : nodes_[k].leaders) {
      if (const int tied = index_[static_cast<std::size_t>(leader)]; tied >= 0) resolve(static_cast<std::size_t>(tied));
      for_each_leader(leader, [&, of_leader = weight](int of, double share) { sums[of] += of_leader * share; });
    }
    nodes_[k].leaders.assign(sums.begin(), sums.end());
    states[k] = Progress::resolved;
  };
  for (std::size_t k = 0; k < nodes_.size(); ++k) resolve(k);
}

void Ties::place(NodalVector& u) const {
  for (const TiedNode& tied : nodes_) {
    Vec3 sum = Vec3::Zero();
    for (const auto& [leader, weight] : tied.leaders) sum += weight * u.col(leader);
    u.col(tied.node) = sum;
  }
}

void Ties::gather(NodalVector& forces) const {
  for (const TiedNode& tied : nodes_) {
    const Vec3 force = forces.col(tied.node);
    forces.col(tied.node).setZero();
    for (const auto& [leader, weight] : tied.leaders) forces.col(leader) += weight * force;
  }
}

// u_s^2 <= sum_j |w_j| sum_i |w_i| u_i^2 by Cauchy's inequality.
void Ties::move_bounds(Vector& b) const {
  for (const TiedNode& tied : nodes_) {
    for (const auto& [leader, weight] : tied.leaders)
      b[leader] += std::abs(weight) * tied.sum_of_magnitudes() * b[tied.node];
    b[tied.node] = 0;
  }
}

std::vector<std::pair<int, int>> Ties::couplings(const Cells& cells,
                                                 const std::vector<std::pair<int, int>>& further) const {
  std::vector<std::pair<int, int>> out;
  const auto couple = [&](const auto& nodes) {
    if (std::none_of(nodes.begin(), nodes.end(), [&](int node) { return is_tied(node); })) return;
    std::set<int> all;
    for (const int node : nodes) for_each_leader(node, [&](int leader, double) { all.insert(leader); });
    for (auto a = all.begin(); a != all.end(); ++a)
      for (auto b = all.begin(); b != a; ++b) out.emplace_back(*a, *b);
  };
  if (empty()) return out;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) couple(cells[cell]);
  for (const auto& [a, b] : further)
    if (is_tied(a) || is_tied(b))
      for_each_leader(
          a, [&](int of_a, double) { for_each_leader(b, [&](int of_b, double) { out.emplace_back(of_a, of_b); }); });
  return out;
}

}  // namespace orthodyn
