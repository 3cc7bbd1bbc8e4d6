#include "lib/fem/terms/pressure.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "lib/element/axial.h"
#include "lib/element/tri3.h"
#include "lib/element/tri6.h"

namespace orthodyn {

namespace {

// Point k at which a face's tangents are evaluated; any point if they are constant.
const Vec3& tangent_point(int k) { return triangle_points_of_degree_5()[static_cast<std::size_t>(k)].L; }

template <Face F>
FaceNodes<F> positions_of(const std::array<int, F::kNodes>& nodes, const NodalVector& x) {
  FaceNodes<F> out;
  for (std::size_t a = 0; a < nodes.size(); ++a) out.col(static_cast<Eigen::Index>(a)) = x.col(nodes[a]);
  return out;
}

}  // namespace

template <Face F>
PressedFace<F>::PressedFace(std::span<const int> its_nodes, const FaceNodes<F>& X, const PointQuantity& p) {
  std::copy(its_nodes.begin(), its_nodes.end(), nodes.begin());
  weights.setZero();
  int k = 0;
  for (const auto& [L, weight] : triangle_points_of_degree_5()) {
    weights.col(std::min(k, F::kTangentPoints - 1)) += 0.5 * weight * p.at(Vec3(X * F::shape(L))) * F::shape(L);
    ++k;
  }
}

template <Face F>
FaceNodes<F> PressedFace<F>::forces(const NodalVector& x) const {
  const FaceNodes<F> corners = positions_of<F>(nodes, x);
  FaceNodes<F> out = FaceNodes<F>::Zero();
  for (int k = 0; k < F::kTangentPoints; ++k)
    out -= normal_at<F>(corners, tangent_point(k)) * weights.col(k).transpose();
  return out;
}

// K_ab = sum_k W_ak A_b(k) with the weights W_ak of tangent point k and the skew matrices
//   A_b = d(x_,1 x x_,2)/dx_b = N_b,2 [x_,1] - N_b,1 [x_,2],  [y] z = y x z.
template <Face F>
typename PressedFace<F>::Stiffness PressedFace<F>::stiffness(const NodalVector& all) const {
  const FaceNodes<F> x = positions_of<F>(nodes, all);
  Stiffness K = Stiffness::Zero();
  for (int k = 0; k < F::kTangentPoints; ++k) {
    const auto slopes = F::slopes(tangent_point(k));
    const Eigen::Matrix<double, 3, 2> tangents = x * slopes;
    const Mat3 first = cross_matrix<double>(tangents.col(0)), second = cross_matrix<double>(tangents.col(1));
    for (Eigen::Index b = 0; b < F::kNodes; ++b) {
      const Mat3 area_gradient = slopes(b, 1) * first - slopes(b, 0) * second;
      for (Eigen::Index a = 0; a < F::kNodes; ++a)
        K.template block<3, 3>(3 * a, 3 * b) += weights(a, k) * area_gradient;
    }
  }
  return K;
}

namespace {

template <Face F>
Mat3 block_of(const typename PressedFace<F>::Stiffness& K, std::size_t i, std::size_t j) {
  return K.template block<3, 3>(3 * static_cast<Eigen::Index>(i), 3 * static_cast<Eigen::Index>(j));
}

}  // namespace

template <Face F>
bool has_symmetric_stiffness(const std::vector<PressedFace<F>>& faces, const NodalVector& x,
                             const std::vector<bool>& held) {
  constexpr double kRoundOff = 1e-10;
  std::map<std::pair<int, int>, Mat3> skew;  // K_ab - K_ba^T for a >= b
  double largest = 0;
  for (const PressedFace<F>& face : faces) {
    const auto K = face.stiffness(x);
    largest = std::max(largest, K.cwiseAbs().maxCoeff());
    for (std::size_t i = 0; i < F::kNodes; ++i)
      for (std::size_t j = 0; j < F::kNodes; ++j)
        if (face.nodes[i] >= face.nodes[j])
          skew.try_emplace({face.nodes[i], face.nodes[j]}, Mat3::Zero()).first->second +=
              block_of<F>(K, i, j) - block_of<F>(K, j, i).transpose();
  }
  const auto is_held = [&](int node, int c) { return held[static_cast<std::size_t>(3 * node + c)]; };
  for (const auto& [nodes, block] : skew)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        if (!is_held(nodes.first, r) && !is_held(nodes.second, c) && std::abs(block(r, c)) > kRoundOff * largest)
          return false;
  return true;
}

template <Face F>
std::unique_ptr<Term> Pressure<F>::part(const Subdomain& subdomain) const {
  std::vector<PressedFace<F>> own;
  for (const PressedFace<F>& face : faces_) {
    if (!subdomain.has_face(face.nodes)) continue;
    own.push_back(face);
    for (int& node : own.back().nodes) node = subdomain.local(node);
  }
  return std::make_unique<Pressure>(surface_, std::move(own), factor_, pattern_);
}

template <Face F>
void Pressure<F>::add_force_of(double factor, const NodalVector& x, NodalVector& f) const {
  for (const PressedFace<F>& face : faces_) {
    const FaceNodes<F> forces = factor * face.forces(x);
    for (std::size_t a = 0; a < F::kNodes; ++a) f.col(face.nodes[a]) += forces.col(static_cast<Eigen::Index>(a));
  }
}

template <Face F>
void Pressure<F>::add_force(const NodalState& s, NodalVector& f) const {
  add_force_of(factor_->value(s.t), s.x, f);
}

template <Face F>
void Pressure<F>::add_peak_force(const NodalState& s, double end, NodalVector& f) const {
  add_force_of(factor_->peak(s.t, end), s.x, f);
}

template <Face F>
void Pressure<F>::add_tangent(const NodalState& s, TangentKind kind, double* stiffness, double*) const {
  if (kind == TangentKind::gauss_newton) return;  // the load stiffness is indefinite
  const double factor = factor_->value(s.t);
  for (const PressedFace<F>& face : faces_) {
    const auto K = face.stiffness(s.x);
    for (std::size_t i = 0; i < F::kNodes; ++i)
      for (std::size_t j = 0; j < F::kNodes; ++j) {
        const int a = face.nodes[i], b = face.nodes[j];
        if (pattern_.symmetric() && a <= b) continue;  // a diagonal block is skew: no symmetric part
        Mat3 block = factor * block_of<F>(K, i, j);
        if (pattern_.symmetric()) block = 0.5 * (block + factor * block_of<F>(K, j, i).transpose());
        pattern_.add(a, b, pattern_.offset(a, b), block, stiffness);
      }
  }
}

template <Face F>
double Pressure<F>::load_power(const NodalState& s) const {
  double power = 0;  // at factor 1
  for (const PressedFace<F>& face : faces_)
    power += face.forces(s.x).cwiseProduct(positions_of<F>(face.nodes, s.v)).sum();
  return factor_->value(s.t) * power;
}

template <Face F>
std::vector<double> Pressure<F>::breakpoints(double start, double end) const {
  return times_between(factor_->kinks(), start, end);
}

template struct PressedFace<Tri3>;
template struct PressedFace<Tri6>;
template bool has_symmetric_stiffness(const std::vector<PressedFace<Tri3>>&, const NodalVector&,
                                      const std::vector<bool>&);
template bool has_symmetric_stiffness(const std::vector<PressedFace<Tri6>>&, const NodalVector&,
                                      const std::vector<bool>&);
template class Pressure<Tri3>;
template class Pressure<Tri6>;

}  // namespace orthodyn
