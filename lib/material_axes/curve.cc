#include "lib/material_axes/curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/material_axes/frame.h"

namespace orthodyn {

namespace {

constexpr std::size_t kChords = 16;  // chords per piece, for the first guess of the search

// The derivatives of the curve at the points with respect to the centripetal parameter, whose steps are d.
std::vector<Vec3> derivatives(const std::vector<Vec3>& p, const std::vector<double>& d) {
  const std::size_t n = p.size();
  std::vector<Vec3> m(n);
  for (std::size_t i = 1; i + 1 < n; ++i)
    m[i] = (p[i] - p[i - 1]) / d[i - 1] - (p[i + 1] - p[i - 1]) / (d[i - 1] + d[i]) + (p[i + 1] - p[i]) / d[i];
  const Vec3 first = (p[1] - p[0]) / d[0], last = (p[n - 1] - p[n - 2]) / d[n - 2];
  m[0] = n == 2 ? first : Vec3(2 * first - m[1]);
  m[n - 1] = n == 2 ? last : Vec3(2 * last - m[n - 2]);
  return m;
}

// Reflection of v at the plane normal to `mirror`.
Vec3 reflected(const Vec3& v, const Vec3& mirror) {
  const double square = mirror.squaredNorm();
  return square > 0 ? Vec3(v - 2 * mirror.dot(v) / square * mirror) : v;
}

}  // namespace

Curve::Curve(const std::vector<Vec3>& points, const std::optional<Vec3>& start_normal) {
  std::vector<double> d;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) d.push_back(std::sqrt((points[i + 1] - points[i]).norm()));
  const auto m = derivatives(points, d);
  for (std::size_t i = 0; i < d.size(); ++i) {
    const Vec3 m0 = d[i] * m[i], m1 = d[i] * m[i + 1], step = points[i + 1] - points[i];
    pieces_.push_back({{points[i], m0, 3 * step - 2 * m0 - m1, m0 + m1 - 2 * step}, Vec3::Zero(), 0});
  }
  for (std::size_t k = 0; k <= kChords * d.size(); ++k)
    samples_.push_back(at(static_cast<double>(k) / static_cast<double>(kChords)));
  for (std::size_t k = 0; k + 1 < samples_.size(); ++k) length_ += (samples_[k + 1] - samples_[k]).norm();
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    Piece& one = pieces_[i];
    one.center = samples_[i * kChords + kChords / 2];
    for (std::size_t k = i * kChords; k <= (i + 1) * kChords; ++k)
      one.radius = std::max(one.radius, (samples_[k] - one.center).norm());
  }
  carry(start_normal.value_or(any_normal(start_tangent())));
}

const Curve::Piece& Curve::piece(double s, double& u) const {
  const double i = std::clamp(std::floor(s), 0.0, static_cast<double>(pieces_.size() - 1));
  u = s - i;
  return pieces_[static_cast<std::size_t>(i)];
}

Vec3 Curve::at(double s) const {
  double u;
  const auto& c = piece(s, u).c;
  return c[0] + u * (c[1] + u * (c[2] + u * c[3]));
}

Vec3 Curve::derivative(double s) const {
  double u;
  const auto& c = piece(s, u).c;
  return c[1] + u * (2 * c[2] + 3 * u * c[3]);
}

void Curve::carry(Vec3 normal) {
  normal = frame(start_tangent(), normal).col(1);
  normals_.push_back(normal);
  for (std::size_t k = 0; k + 1 < samples_.size(); ++k) {
    const double s = static_cast<double>(k) / static_cast<double>(kChords);
    const Vec3 chord = samples_[k + 1] - samples_[k];
    const Vec3 tangent = derivative(s).normalized();
    const Vec3 next = derivative(s + 1 / static_cast<double>(kChords)).normalized();
    normal = reflected(reflected(normal, chord), next - reflected(tangent, chord));
    normals_.push_back(frame(next, normal).col(1));
  }
}

Curve::Guess Curve::nearest_chord(const Vec3& x) const {
  Guess best{0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if ((x - pieces_[i].center).norm() - pieces_[i].radius > best.distance) continue;
    for (std::size_t k = i * kChords; k < (i + 1) * kChords; ++k) {
      const Vec3 chord = samples_[k + 1] - samples_[k], arm = x - samples_[k];
      const double t = std::clamp(arm.dot(chord) / chord.squaredNorm(), 0.0, 1.0);
      if (const double distance = (arm - t * chord).norm(); distance < best.distance)
        best = {(static_cast<double>(k) + t) / static_cast<double>(kChords), distance};
    }
  }
  return best;
}

// Solves (c(s) - x) . c'(s) = 0 within a chord of the first guess. Bisection, because the derivative of the tangent
// jumps at the points, where Newton's method may fail.
double Curve::refined(const Vec3& x, const Guess& start) const {
  const auto slope = [&](double s) { return (at(s) - x).dot(derivative(s)); };
  const double step = 1 / static_cast<double>(kChords);
  double low = std::max(0.0, start.s - step);
  double high = std::min(static_cast<double>(pieces_.size()), start.s + step);
  if (slope(low) >= 0) return low == 0 ? low : start.s;
  if (slope(high) <= 0) return high == static_cast<double>(pieces_.size()) ? high : start.s;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (slope(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Curve::FootPoint Curve::nearest(const Vec3& x) const {
  const double s = refined(x, nearest_chord(x));
  const double k = std::min(std::floor(s * kChords), static_cast<double>(samples_.size() - 2)), t = s * kChords - k;
  const auto i = static_cast<std::size_t>(k);
  const Mat3 at_foot = frame(derivative(s), (1 - t) * normals_[i] + t * normals_[i + 1]);
  return {at(s), at_foot.col(0), at_foot.col(1)};
}

}  // namespace orthodyn
