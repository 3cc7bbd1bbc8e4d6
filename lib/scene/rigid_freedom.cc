#include "lib/scene/rigid_freedom.h"

#include <fmt/format.h>

#include <numeric>

#include "lib/core/values.h"

namespace orthodyn {

namespace {

using Motions = Eigen::Matrix<double, Eigen::Dynamic, 6>;

constexpr double kHeld = 1e-9;    // of a motion of size one at a clamped coordinate
constexpr double kRoundOff = 1e-14;  // of the stiffness that each coordinate has of its own

// For each node the number of its connected part; -1 for nodes of no element.
std::vector<int> parts_of(const TetMesh& mesh) {
  std::vector<int> parent(mesh.nodes.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[static_cast<std::size_t>(i)] != i) i = parent[static_cast<std::size_t>(i)] = parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(i)])];
    return i;
  };
  for (const auto& tet : mesh.tets)
    for (const int node : tet) parent[static_cast<std::size_t>(root(node))] = root(tet[0]);
  std::vector<int> number(mesh.nodes.size(), -1), part(mesh.nodes.size(), -1);
  int count = 0;
  for (const auto& tet : mesh.tets)
    for (const int node : tet) {
      int& k = number[static_cast<std::size_t>(root(node))];
      if (k < 0) k = count++;
      part[static_cast<std::size_t>(node)] = k;
    }
  return part;
}

// One part's six rigid motions, all of size one.
class RigidMotions {
 public:
  RigidMotions(const FemModel& model, const std::vector<int>& part_of, int part) : model_(model) {
    for (std::size_t i = 0; i < part_of.size(); ++i)
      if (part_of[i] == part) nodes_.push_back(static_cast<int>(i));
    const auto& x = *model.parts().rest;
    center_ = Vec3::Zero();
    for (const int i : nodes_) center_ += x.col(i) / static_cast<double>(nodes_.size());
    for (const int i : nodes_) radius_ = std::max(radius_, (x.col(i) - center_).norm());
  }

  const Vec3& center() const { return center_; }

  // The combinations of the six that vanish at all clamped coordinates, as columns.
  Eigen::MatrixXd not_clamped() const {
    Eigen::Matrix<double, 6, 6> gram = Eigen::Matrix<double, 6, 6>::Zero();
    for (const int i : nodes_) {
      const auto at_node = motions(i);
      for (std::size_t c = 0; c < 3; ++c)
        if (model_.parts().dofs->node(i)[c] < 0) {
          const auto row = at_node.row(static_cast<Eigen::Index>(c));
          gram += row.transpose() * row;
        }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(gram);
    const auto free = (eigen.eigenvalues().array() <= kHeld * kHeld * std::max(1.0, eigen.eigenvalues()[5])).count();
    return eigen.eigenvectors().leftCols(free);
  }

  // At the free coordinates.
  Eigen::MatrixXd on_dofs(const Eigen::MatrixXd& combinations) const {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(model_.num_dofs(), combinations.cols());
    for (const int i : nodes_) {
      const Eigen::MatrixXd moved = motions(i) * combinations;
      for (std::size_t c = 0; c < 3; ++c)
        if (const int dof = model_.parts().dofs->node(i)[c]; dof >= 0)
          out.row(dof) = moved.row(static_cast<Eigen::Index>(c));
    }
    return out;
  }

 private:
  Eigen::Matrix<double, 3, 6> motions(int node) const {
    const Vec3 arm = (model_.parts().rest->col(node) - center_) / radius_;
    Eigen::Matrix<double, 3, 6> out;
    out.leftCols<3>().setIdentity();
    for (int k = 0; k < 3; ++k) out.col(3 + k) = Vec3::Unit(k).cross(arm);
    return out;
  }

  const FemModel& model_;
  std::vector<int> nodes_;
  Vec3 center_;
  double radius_ = 0;
};

// Those combinations of `motions` that K does not resist.
Eigen::MatrixXd without_stiffness(const Eigen::MatrixXd& combinations, const Eigen::MatrixXd& motions,
                                  const Pattern& pattern, const std::vector<double>& stiffness) {
  Eigen::MatrixXd resisted(motions.rows(), motions.cols());
  for (Eigen::Index k = 0; k < motions.cols(); ++k) {
    Vector force(motions.rows());
    pattern.multiply(stiffness.data(), motions.col(k), force);
    resisted.col(k) = force;
  }
  const Vector own = SparseMatrix(pattern.matrix(stiffness.data())).diagonal().cwiseAbs();
  const double round_off = kRoundOff * (motions.array().square().colwise() * own.array()).colwise().sum().maxCoeff();
  const Eigen::MatrixXd energy = motions.transpose() * resisted;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen((energy + energy.transpose()) / 2);
  const auto free = (eigen.eigenvalues().array() <= round_off).count();
  return combinations * eigen.eigenvectors().leftCols(free);
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
    words.push_back(fmt::format("move in {} {}combined way{}", more, words.empty() ? "" : "further ", more > 1 ? "s" : ""));
  std::string text = "can " + words[0];
  for (std::size_t k = 1; k < words.size(); ++k) text += " and " + words[k];
  return text;
}

}  // namespace

std::string describe_rigid_freedom(const FemModel& model, double t) {
  const auto part_of = parts_of(model.parts().mesh);
  const int count = part_of.empty() ? 0 : *std::max_element(part_of.begin(), part_of.end()) + 1;
  Linearization at;
  for (int part = 0; part < count; ++part) {
    const RigidMotions rigid(model, part_of, part);
    Eigen::MatrixXd free = rigid.not_clamped();
    if (free.cols() == 0) continue;
    if (at.stiffness.empty()) {
      const Vector zero = Vector::Zero(model.num_dofs());
      model.linearize(t, zero, zero, TangentKind::gauss_newton, at);
    }
    free = without_stiffness(free, rigid.on_dofs(free), model.pattern(), at.stiffness);
    if (free.cols() == 0) continue;
    const std::string which = count == 1 ? "the body" : "the part of the body about " + Value<Vec3>::yaml(rigid.center()) + " m";
    return which + " " + sentence(free);
  }
  return "";
}

}  // namespace orthodyn
