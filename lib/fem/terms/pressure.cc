#include "lib/fem/terms/pressure.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "lib/element/axial.h"
#include "lib/fem/face_nodes.h"
#include "lib/fem/subdomain.h"

namespace orthodyn {

namespace {

// Point k at which a face's tangents are evaluated; any point if they are constant.
template <Face F>
const Vec3& tangent_point(int k) {
  return F::points()[static_cast<std::size_t>(k)].place;
}

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
  for (const auto& [place, weight] : F::points()) {
    weights.col(std::min(k, F::kTangentPoints - 1)) += weight * p.at(Vec3(X * F::shape(place))) * F::shape(place);
    ++k;
  }
}

template <Face F>
FaceNodes<F> PressedFace<F>::forces(const NodalVector& x) const {
  const FaceNodes<F> corners = positions_of<F>(nodes, x);
  FaceNodes<F> out = FaceNodes<F>::Zero();
  for (int k = 0; k < F::kTangentPoints; ++k)
    out -= normal_at<F>(corners, tangent_point<F>(k)) * weights.col(k).transpose();
  return out;
}

// K_ab = sum_k W_ak A_b(k) with the weights W_ak of tangent point k and the skew matrices
//   A_b = d(x_,1 x x_,2)/dx_b = N_b,2 [x_,1] - N_b,1 [x_,2],  [y] z = y x z.
template <Face F>
typename PressedFace<F>::Stiffness PressedFace<F>::stiffness(const NodalVector& all) const {
  const FaceNodes<F> x = positions_of<F>(nodes, all);
  Stiffness K = Stiffness::Zero();
  for (int k = 0; k < F::kTangentPoints; ++k) {
    const auto slopes = F::slopes(tangent_point<F>(k));
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

PressedFaces::PressedFaces(const Mesh& mesh, const std::vector<FaceCorners>& faces, const PointQuantity& p) {
  for_each_face(mesh, faces, [&]<Face F>(std::span<const int> nodes, const FaceNodes<F>& X) {
    std::get<List<F>>(lists_).emplace_back(nodes, X, p);
  });
}

PressedFaces PressedFaces::part(const Subdomain& subdomain) const {
  PressedFaces out;
  for_each([&]<Face F>(const PressedFace<F>& face) {
    const std::span<const int> nodes = face.nodes;
    if (!subdomain.has_face(FaceCorners(nodes.first(PressedFace<F>::kCorners)))) return;
    PressedFace<F> own = face;
    for (int& node : own.nodes) node = subdomain.local(node);
    std::get<List<F>>(out.lists_).push_back(std::move(own));
  });
  return out;
}

std::size_t PressedFaces::bytes() const {
  std::size_t sum = 0;
  for_each([&](const auto& face) { sum += sizeof(face); });
  return sum;
}

NodalForces pressure_forces(const PressedFaces& faces, const NodalVector& x) {
  std::map<int, Vec3> sums;
  faces.for_each([&]<Face F>(const PressedFace<F>& face) {
    const FaceNodes<F> forces = face.forces(x);
    for (std::size_t a = 0; a < face.nodes.size(); ++a)
      sums.try_emplace(face.nodes[a], Vec3::Zero()).first->second += forces.col(static_cast<Eigen::Index>(a));
  });
  return {sums.begin(), sums.end()};
}

bool has_symmetric_stiffness(const PressedFaces& faces, const NodalVector& x, const std::vector<bool>& held) {
  constexpr double kRoundOff = 1e-10;
  std::map<std::pair<int, int>, Mat3> skew;  // K_ab - K_ba^T for a >= b
  double largest = 0;
  faces.for_each([&]<Face F>(const PressedFace<F>& face) {
    const auto K = face.stiffness(x);
    largest = std::max(largest, K.cwiseAbs().maxCoeff());
    for (std::size_t i = 0; i < F::kNodes; ++i)
      for (std::size_t j = 0; j < F::kNodes; ++j)
        if (face.nodes[i] >= face.nodes[j])
          skew.try_emplace({face.nodes[i], face.nodes[j]}, Mat3::Zero()).first->second +=
              block_of<F>(K, i, j) - block_of<F>(K, j, i).transpose();
  });
  const auto is_held = [&](int node, int c) { return held[static_cast<std::size_t>(3 * node + c)]; };
  for (const auto& [nodes, block] : skew)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        if (!is_held(nodes.first, r) && !is_held(nodes.second, c) && std::abs(block(r, c)) > kRoundOff * largest)
          return false;
  return true;
}

std::unique_ptr<Term> Pressure::part(const Subdomain& subdomain) const {
  return std::make_unique<Pressure>(surface_, faces_.part(subdomain), factor_, pattern_);
}

void Pressure::add_force_of(double factor, const NodalVector& x, NodalVector& f) const {
  faces_.for_each([&]<Face F>(const PressedFace<F>& face) {
    const FaceNodes<F> forces = factor * face.forces(x);
    for (std::size_t a = 0; a < F::kNodes; ++a) f.col(face.nodes[a]) += forces.col(static_cast<Eigen::Index>(a));
  });
}

void Pressure::add_force(const NodalState& s, NodalVector& f) const { add_force_of(factor_->value(s.t), s.x, f); }

void Pressure::add_peak_force(const NodalState& s, double end, NodalVector& f) const {
  add_force_of(factor_->peak(s.t, end), s.x, f);
}

void Pressure::add_tangent(const NodalState& s, TangentKind kind, double* stiffness, double*) const {
  if (kind == TangentKind::gauss_newton) return;  // the load stiffness is indefinite
  const double factor = factor_->value(s.t);
  faces_.for_each([&]<Face F>(const PressedFace<F>& face) {
    const auto K = face.stiffness(s.x);
    for (std::size_t i = 0; i < F::kNodes; ++i)
      for (std::size_t j = 0; j < F::kNodes; ++j) {
        const int a = face.nodes[i], b = face.nodes[j];
        if (pattern_.symmetric() && a <= b) continue;  // a diagonal block is skew: no symmetric part
        Mat3 block = factor * block_of<F>(K, i, j);
        if (pattern_.symmetric()) block = 0.5 * (block + factor * block_of<F>(K, j, i).transpose());
        pattern_.add(a, b, pattern_.offset(a, b), block, stiffness);
      }
  });
}

double Pressure::load_power(const NodalState& s) const {
  double power = 0;  // at factor 1
  faces_.for_each([&]<Face F>(const PressedFace<F>& face) {
    power += face.forces(s.x).cwiseProduct(positions_of<F>(face.nodes, s.v)).sum();
  });
  return factor_->value(s.t) * power;
}

std::vector<double> Pressure::breakpoints(double start, double end) const {
  return times_between(factor_->kinks(), start, end);
}

}  // namespace orthodyn
