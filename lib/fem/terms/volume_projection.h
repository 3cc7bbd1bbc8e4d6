// Projects the volume strain of a region's elements onto polynomials in each element: constant, or linear in space.
//
// The polynomials psi_i are orthonormal over the element's integration points, sum_p V_p psi_i psi_j = delta_ij. The
// projection of theta is sum_i t_i psi_i with t_i = sum_p V_p psi_i theta_p, and the integral of its square is sum
// t_i^2.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "lib/fem/element_batches.h"
#include "lib/fem/element_type.h"

namespace orthodyn {

// Values of psi_i (m^-3/2) at the integration points: one row per point, one column per polynomial. `terms`: 1 for the
// constant, 4 for linear polynomials. `places`: the points, m. `V`: their volumes, m^3.
Eigen::MatrixXd orthonormal_polynomials(int terms, const Eigen::Matrix3Xd& places, const Vector& V);

inline namespace ORTHODYN_LANES {

template <Element E>
class VolumeProjection {
 public:
  static constexpr int kTerms = E::kPressures;
  // One number per polynomial.
  using Coefficients = std::array<Batch, static_cast<std::size_t>(kTerms)>;

  // `cells`: the cells from which `elements` was made, in the same order. The arguments need not outlive this object.
  VolumeProjection(const ElementType& type, const ElementMesh& mesh, const std::vector<int>& cells,
                   const ElementBatches<E>& elements)
      : num_points_(elements.num_points()),
        values_(static_cast<std::size_t>(elements.num_batches() * num_points_ * kTerms)) {
    for (int k = 0; k < elements.num_batches() * Batch::kLanes; ++k) {
      const int element = std::min(k, elements.size() - 1);  // lanes of padding repeat the last element
      const auto cell = static_cast<std::size_t>(cells[static_cast<std::size_t>(element)]);
      const Eigen::MatrixXd psi =
          orthonormal_polynomials(kTerms, type.points(mesh.positions(cell)), volumes(elements, element));
      for (int p = 0; p < num_points_; ++p)
        for (int i = 0; i < kTerms; ++i)
          values_[index(k / Batch::kLanes, p, i)][static_cast<std::size_t>(k % Batch::kLanes)] = psi(p, i);
    }
  }

  std::size_t bytes() const { return values_.capacity() * sizeof(Lanes); }

  // psi_i at a point of a batch, m^-3/2.
  Batch polynomial(int batch, int point, int i) const { return Batch::load(values_[index(batch, point, i)].data()); }

  // sum_i c_i psi_i at a point.
  Batch at(int batch, int point, const Coefficients& c) const {
    Batch sum = c[0] * polynomial(batch, point, 0);
    for (int i = 1; i < kTerms; ++i) sum += c[static_cast<std::size_t>(i)] * polynomial(batch, point, i);
    return sum;
  }

  // Adds V psi_i theta of a point to each c_i.
  void add(int batch, int point, const Batch& V_theta, Coefficients& c) const {
    for (int i = 0; i < kTerms; ++i) c[static_cast<std::size_t>(i)] += V_theta * polynomial(batch, point, i);
  }

 private:
  using Lanes = std::array<double, static_cast<std::size_t>(Batch::kLanes)>;

  static Vector volumes(const ElementBatches<E>& elements, int k) {
    Vector V(elements.num_points());
    for (int p = 0; p < elements.num_points(); ++p) V[p] = elements.volume(k, p);
    return V;
  }

  std::size_t index(int batch, int point, int i) const {
    return static_cast<std::size_t>((batch * num_points_ + point) * kTerms + i);
  }

  int num_points_;
  std::vector<Lanes> values_;
};

}  // namespace ORTHODYN_LANES

}  // namespace orthodyn
