#include "lib/analysis/rigid_freedom.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "lib/analysis/singular_vectors.h"
#include "lib/core/spelling.h"
#include "lib/mesh/quadratic.h"

namespace orthodyn {

namespace {

constexpr double kHeld = 1e-9;       // smaller singular values, relative to the largest, mean that no clamp resists
constexpr double kRoundOff = 1e-14;  // of r^T K r, relative to its value with the diagonal of K

// For each node the index of its connected component; -1 for nodes without an element. Ties connect bodies.
std::vector<int> parts_of(const Mesh& mesh, const Ties& ties) {
  std::vector<int> parent(mesh.nodes.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    const auto up = [&](int k) -> int& { return parent[static_cast<std::size_t>(k)]; };
    while (up(i) != i) i = up(i) = up(up(i));
    return i;
  };
  const Cells& cells = mesh.cells;
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (const int node : cells[c]) parent[static_cast<std::size_t>(root(node))] = root(cells[c][0]);
  for (const TiedNode& tied : ties.nodes())
    for (const auto& [leader, weight] : tied.leaders) parent[static_cast<std::size_t>(root(leader))] = root(tied.node);
  std::vector<int> number(mesh.nodes.size(), -1), part(mesh.nodes.size(), -1);
  int count = 0;
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (const int node : cells[c]) {
      int& k = number[static_cast<std::size_t>(root(node))];
      if (k < 0) k = count++;
      part[static_cast<std::size_t>(node)] = k;
    }
  return part;
}

using Flags = Eigen::Array<bool, Eigen::Dynamic, 1>;

Eigen::MatrixXd columns_where(const Eigen::MatrixXd& all, const Flags& wanted) {
  Eigen::MatrixXd out(all.rows(), wanted.count());
  for (Eigen::Index k = 0, next = 0; k < all.cols(); ++k)
    if (wanted[k]) out.col(next++) = all.col(k);
  return out;
}

// Per coordinate of the whole mesh (3 * node + component): 1 if clamped or if the node has no element, else 0.
// Collective.
std::vector<double> clamped_coordinates(const FemModel& model) {
  const DofMap& dofs = *model.parts().dofs;
  std::vector<double> here;
  for (int i = 0; i < dofs.num_nodes(); ++i)
    for (int k = 0; k < 3; ++k) here.push_back(dofs.is_held(i, k) ? 1 : 0);
  const Subdomain* subdomain = model.parts().subdomain.get();
  return subdomain ? subdomain->whole_field(here, 3) : here;
}

// The six rigid motions of one connected component, scaled to similar size.
class RigidMotions {
 public:
  // `clamped`: result of clamped_coordinates(); must outlive this object.
  RigidMotions(const FemModel& model, const std::vector<double>& clamped, const std::vector<int>& part_of, int part)
      : model_(model), clamped_(clamped) {
    for (std::size_t i = 0; i < part_of.size(); ++i)
      if (part_of[i] == part) nodes_.push_back(static_cast<int>(i));
    center_ = Vec3::Zero();
    for (const int i : nodes_) center_ += place(i) / static_cast<double>(nodes_.size());
    for (const int i : nodes_) radius_ = std::max(radius_, (place(i) - center_).norm());
  }

  const Vec3& center() const { return center_; }

  // Basis of the rigid motions that vanish at all clamped coordinates: combinations of the six, one per column.
  Eigen::MatrixXd not_clamped() const {
    const Eigen::MatrixXd held = at_clamps();
    if (held.rows() == 0) return Eigen::MatrixXd::Identity(6, 6);
    const SingularVectors combinations = right_singular_vectors(held);
    return columns_where(combinations.V, combinations.values.array() <= kHeld * combinations.values.maxCoeff());
  }

  // Displacements of the given combinations at the free coordinates of this rank's nodes, copies included.
  Eigen::MatrixXd on_dofs(const Eigen::MatrixXd& combinations) const {
    const auto& [dofs, subdomain] = std::tie(model_.parts().dofs, model_.parts().subdomain);
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(dofs->num_dofs_here(), combinations.cols());
    for (const int i : nodes_) {
      const int here = subdomain ? subdomain->local(i) : i;
      if (here < 0) continue;
      const Eigen::MatrixXd moved = motions(i).lazyProduct(combinations);
      for (std::size_t c = 0; c < 3; ++c)
        if (const int dof = dofs->node(here)[c]; dof >= 0) out.row(dof) = moved.row(static_cast<Eigen::Index>(c));
    }
    return out;
  }

 private:
  // Displacements of the six motions, one row per clamped coordinate.
  Eigen::MatrixXd at_clamps() const {
    std::vector<Eigen::Matrix<double, 1, 6>> rows;
    for (const int i : nodes_)
      for (int c = 0; c < 3; ++c)
        if (clamped_[static_cast<std::size_t>(3 * i + c)] > 0) rows.push_back(motions(i).row(c));
    Eigen::MatrixXd out(static_cast<Eigen::Index>(rows.size()), 6);
    for (std::size_t k = 0; k < rows.size(); ++k) out.row(static_cast<Eigen::Index>(k)) = rows[k];
    return out;
  }

  Eigen::Matrix<double, 3, 6> motions(int node) const {
    const Vec3 arm = (place(node) - center_) / radius_;
    Eigen::Matrix<double, 3, 6> out;
    out.leftCols<3>().setIdentity();
    for (int k = 0; k < 3; ++k) out.col(3 + k) = Vec3::Unit(k).cross(arm);
    return out;
  }

  const Vec3& place(int node) const { return model_.parts().mesh.nodes[static_cast<std::size_t>(node)]; }

  const FemModel& model_;
  const std::vector<double>& clamped_;
  std::vector<int> nodes_;
  Vec3 center_;
  double radius_ = 0;
};

// Motions in the span of `combinations` without stiffness. `motions`: their displacements, `stiffness`: K, on this
// rank.
Eigen::MatrixXd without_stiffness(const Eigen::MatrixXd& combinations, const Eigen::MatrixXd& motions,
                                  const FemModel& model, const std::vector<double>& stiffness) {
  const Pattern& pattern = model.pattern();
  Eigen::MatrixXd resisted(motions.rows(), motions.cols());
  for (Eigen::Index k = 0; k < motions.cols(); ++k) {
    Vector force(motions.rows());
    pattern.multiply(stiffness.data(), motions.col(k), force);
    resisted.col(k) = force;
  }
  const Vector own = SparseMatrix(pattern.matrix(stiffness.data())).diagonal().cwiseAbs();
  Eigen::MatrixXd sums(motions.cols() + 1, motions.cols());  // r_i^T K r_j; last row: sum_k |K_kk| r_j[k]^2
  sums << motions.transpose().lazyProduct(resisted), (motions.array().square().colwise() * own.array()).colwise().sum();
  if (model.ranks()) model.ranks()->sum({sums.data(), static_cast<std::size_t>(sums.size())});
  const double round_off = kRoundOff * sums.bottomRows(1).maxCoeff();
  const Eigen::MatrixXd energy = sums.topRows(motions.cols());
  const Eigen::MatrixXd axes = right_singular_vectors((energy + energy.transpose()) / 2).V;  // eigenvectors
  const Flags free = axes.cwiseProduct(energy.lazyProduct(axes)).colwise().sum().transpose().array() <= round_off;
  return combinations.lazyProduct(columns_where(axes, free));
}

std::string sentence(const Eigen::MatrixXd& free) {
  constexpr double kAlong = 1 - 1e-6;
  std::vector<std::string> along, about;
  for (int k = 0; k < 6; ++k)
    if (free.row(k).norm() > kAlong) (k < 3 ? along : about).push_back(std::string(1, static_cast<char>('x' + k % 3)));
  std::vector<std::string> words;
  if (!along.empty()) words.push_back("be translated along " + join(along));
  if (!about.empty()) words.push_back((along.empty() ? "be rotated about " : "rotated about ") + join(about));
  if (const auto more = free.cols() - static_cast<Eigen::Index>(along.size() + about.size()); more > 0)
    words.push_back(
        fmt::format("move in {} {}combined way{}", more, words.empty() ? "" : "further ", more > 1 ? "s" : ""));
  std::string text = "can " + words[0];
  for (std::size_t k = 1; k < words.size(); ++k) text += " and " + words[k];
  return text;
}

// Centre (m) of a connected component, and its free rigid motions: one column of six coefficients each.
struct FreePart {
  Vec3 center;
  Eigen::MatrixXd motions;
  std::vector<std::string> regions;
};

std::vector<std::string> regions_of(int part, const std::vector<int>& part_of, const Mesh& mesh) {
  std::set<int> found;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (part_of[static_cast<std::size_t>(mesh.cells[c][0])] == part) found.insert(mesh.region_of[c]);
  std::vector<std::string> names;
  for (const int region : found) names.push_back(mesh.region_names[static_cast<std::size_t>(region)]);
  return names;
}

std::vector<FreePart> freedom_of_parts(const FemModel& model, double t) {
  const auto part_of = parts_of(model.parts().mesh, model.parts().dofs->ties());
  const int count = part_of.empty() ? 0 : *std::max_element(part_of.begin(), part_of.end()) + 1;
  const std::vector<double> clamped = clamped_coordinates(model);
  Linearization at;
  bool is_linearized = false;
  std::vector<FreePart> all;
  for (int part = 0; part < count; ++part) {
    const RigidMotions rigid(model, clamped, part_of, part);
    Eigen::MatrixXd free = rigid.not_clamped();
    if (free.cols() > 0 && !std::exchange(is_linearized, true)) {
      const Vector zero = Vector::Zero(model.num_dofs());
      model.linearize(t, zero, zero, TangentKind::gauss_newton, at);
    }
    if (free.cols() > 0) free = without_stiffness(free, rigid.on_dofs(free), model, at.stiffness);
    auto regions = free.cols() > 0 ? regions_of(part, part_of, model.parts().mesh) : std::vector<std::string>();
    all.push_back({rigid.center(), std::move(free), std::move(regions)});
  }
  return all;
}

}  // namespace

std::string describe_rigid_freedom(const FemModel& model, double t) {
  const auto parts = freedom_of_parts(model, t);
  for (const auto& part : parts) {
    if (part.motions.cols() == 0) continue;
    const Vec3& x = part.center;
    const std::string name = parts.size() == 1
                                 ? "the body "
                                 : fmt::format("the part of the body about [{:.4g}, {:.4g}, {:.4g}] m (region {}) ",
                                               x[0], x[1], x[2], join(part.regions));
    const auto& contacts = model.parts().contacts;
    return name + sentence(part.motions) + (contacts.empty() ? "" : " (contact does not hold it)");
  }
  return "";
}

int count_rigid_freedom(const FemModel& model, double t) {
  Eigen::Index sum = 0;
  for (const auto& part : freedom_of_parts(model, t)) sum += part.motions.cols();
  return static_cast<int>(sum);
}

}  // namespace orthodyn
