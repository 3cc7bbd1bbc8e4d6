// Example of a user's term: springs that tie all nodes within a sphere to their rest positions.
#include "lib/fem/term_choice.h"

namespace {

using namespace orthodyn;

class GroundSprings : public Term {
 public:
  GroundSprings(double stiffness, std::vector<int> nodes, const Discretization& body)
      : k_(stiffness), nodes_(std::move(nodes)), pattern_(body.pattern) {}

  std::string name() const override { return "springs to ground"; }
  std::string description() const override { return name() + ": " + std::to_string(nodes_.size()) + " nodes"; }

  void add_force(const NodalState& s, NodalVector& f) const override {
    for (const int i : nodes_) f.col(i) -= k_ * s.u.col(i);
  }

  // Adds the stiffness -df/dx: k times the identity in the diagonal block of each node.
  void add_tangent(const NodalState&, TangentKind, double* stiffness, double*) const override {
    for (const int i : nodes_) pattern_.add(i, i, pattern_.offset(i, i), k_ * Mat3::Identity(), stiffness);
  }

  // Adds a bound of the stiffness, which limits the step of explicit schemes.
  void add_stiffness_bound(Vector& row_sums) const override {
    for (const int i : nodes_) row_sums[i] += k_;
  }

  EnergyKind energy_kind() const override { return EnergyKind::elastic; }
  double energy(const NodalState& s) const override {
    double sum = 0;
    for (const int i : nodes_) sum += 0.5 * k_ * s.u.col(i).squaredNorm();
    return sum;
  }

 private:
  double k_;
  std::vector<int> nodes_;
  const BlockPattern& pattern_;
};

class GroundSpringsChoice : public TermChoice {
 public:
  static const Spec<GroundSpringsChoice>& spec() {
    using G = GroundSpringsChoice;
    static const auto s =
        Spec<G>()
            .key("center", &G::center_, "Centre of the sphere.", {.required = true, .unit = "m"})
            .key("radius", &G::radius_, "Radius of the sphere.", {.required = true, .unit = "m", .range = kPositive})
            .key("stiffness", &G::stiffness_, "Stiffness of the spring at each node.",
                 {.required = true, .unit = "N/m", .range = kPositive});
    return s;
  }

  std::unique_ptr<Term> make(const Discretization& body) const override {
    std::vector<int> nodes;
    for (int i = 0; i < body.rest.cols(); ++i)
      if ((body.rest.col(i) - center_).norm() <= radius_) nodes.push_back(i);
    if (nodes.empty()) origin.fail("no node lies in the sphere; make the radius larger");
    return std::make_unique<GroundSprings>(stiffness_, std::move(nodes), body);
  }

  SourceLocation origin;  // place in the input, for error messages; set by the reader

 private:
  Vec3 center_ = Vec3::Zero();
  double radius_ = 0, stiffness_ = 0;
};

const bool ground_springs_registered =
    Registry<TermChoice>::add<GroundSpringsChoice>("ground_springs", "Springs between nodes and their rest positions.");

}  // namespace
