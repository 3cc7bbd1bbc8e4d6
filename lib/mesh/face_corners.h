// A face of a cell, given by its corners: a triangle or a quadrilateral.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <span>

namespace orthodyn {

class FaceCorners {
 public:
  FaceCorners() = default;
  // Corners in cyclic order.
  FaceCorners(int a, int b, int c) : corners_{a, b, c, kNone} {}
  FaceCorners(int a, int b, int c, int d) : corners_{a, b, c, d} {}
  explicit FaceCorners(std::span<const int> corners) { std::copy(corners.begin(), corners.end(), corners_.begin()); }

  std::size_t size() const { return corners_[3] == kNone ? 3 : 4; }
  int operator[](std::size_t k) const { return corners_[k]; }
  const int* begin() const { return corners_.data(); }
  const int* end() const { return begin() + size(); }
  int* begin() { return corners_.data(); }
  int* end() { return begin() + size(); }

  // The corner after corner k.
  int after(std::size_t k) const { return corners_[(k + 1) % size()]; }

  // The face as seen from its other side.
  FaceCorners reversed() const {
    FaceCorners out = *this;
    std::swap(out.corners_[1], out.corners_[size() - 1]);
    return out;
  }

  // Puts the corners into the order that is the same for all ways to list this face: the smallest first, the smaller of
  // its neighbours second. Returns true if this reverses the face.
  bool sort() {
    std::rotate(begin(), std::min_element(begin(), end()), end());
    const bool reverses = corners_[1] > corners_[size() - 1];
    if (reverses) *this = reversed();
    return reverses;
  }

  auto operator<=>(const FaceCorners&) const = default;

 private:
  static constexpr int kNone = -1;
  std::array<int, 4> corners_{kNone, kNone, kNone, kNone};
};

}  // namespace orthodyn
