#include "lib/fem/joint_coordinate.h"

#include <cmath>

#include "lib/core/errors.h"

namespace orthodyn {

JointCoordinate JointCoordinate::sliding(JointPoint first, JointPoint from, JointPoint to) {
  const double length = (to.rest - from.rest).norm();
  return {Kind::slide, {std::move(first), std::move(from), std::move(to)}, {{Vec3(1, -1, 0), Vec3(0, -1, 1), length}}};
}

JointCoordinate JointCoordinate::turning(JointPoint from, JointPoint side, JointPoint second_from,
                                         JointPoint second_side, JointPoint second_other) {
  Vector a(5), b(5), c(5);
  a << -1, 1, 0, 0, 0;
  b << 0, 0, -1, 1, 0;
  c << 0, 0, -1, 0, 1;
  return {Kind::turn,
          {std::move(from), std::move(side), std::move(second_from), std::move(second_side), std::move(second_other)},
          {{a, b, 1}, {a, c, 1}}};
}

JointCoordinate JointCoordinate::stretching(JointPoint first, JointPoint second) {
  const Eigen::Vector2d span(1, -1);
  return {Kind::stretch, {std::move(first), std::move(second)}, {{span, span, 1}}};
}

Eigen::Matrix3Xd JointCoordinate::places(const NodalVector& u) const {
  Eigen::Matrix3Xd p(3, std::ssize(points_));
  for (Eigen::Index i = 0; i < p.cols(); ++i) {
    const JointPoint& point = points_[static_cast<std::size_t>(i)];
    p.col(i) = point.rest + point.mean(u);
  }
  return p;
}

double JointCoordinate::value_of(const Product& product, const Eigen::Matrix3Xd& p) const {
  const Vec3 r = p * product.r, s = p * product.s;
  return r.dot(s) / product.scale;
}

Vector JointCoordinate::slope_of(const Product& product, const Eigen::Matrix3Xd& p) const {
  const Vec3 r = p * product.r, s = p * product.s;
  const Eigen::Matrix3Xd slope = (s * product.r.transpose() + r * product.s.transpose()) / product.scale;
  return slope.reshaped();
}

Eigen::MatrixXd JointCoordinate::curvature_of(const Product& product) const {
  const Eigen::MatrixXd pairs = (product.r * product.s.transpose() + product.s * product.r.transpose()) / product.scale;
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * pairs.rows(), 3 * pairs.cols());
  for (Eigen::Index i = 0; i < pairs.rows(); ++i)
    for (Eigen::Index j = 0; j < pairs.cols(); ++j) out.block<3, 3>(3 * i, 3 * j) = pairs(i, j) * Mat3::Identity();
  return out;
}

double JointCoordinate::value(const NodalVector& u) const {
  const Eigen::Matrix3Xd p = places(u);
  const double first = value_of(products_[0], p);
  switch (kind_) {
    case Kind::slide: return first;
    case Kind::turn: return std::atan2(value_of(products_[1], p), first);
    case Kind::stretch: return std::sqrt(first) - length_at_rest();
  }
  return 0;
}

double JointCoordinate::rate(const NodalVector& u, const NodalVector& v) const {
  const Vector slope = expand(u).slope;
  double sum = 0;
  for (std::size_t i = 0; i < points_.size(); ++i)
    sum += slope.segment<3>(3 * static_cast<Eigen::Index>(i)).dot(points_[i].mean(v));
  return sum;
}

JointCoordinate::Expansion JointCoordinate::expand(const NodalVector& u) const {
  const Eigen::Matrix3Xd p = places(u);
  switch (kind_) {
    case Kind::slide: return expand_slide(p);
    case Kind::turn: return expand_turn(p);
    case Kind::stretch: return expand_stretch(p);
  }
  return {};
}

JointCoordinate::Expansion JointCoordinate::expand_slide(const Eigen::Matrix3Xd& p) const {
  return {value_of(products_[0], p), slope_of(products_[0], p), curvature_of(products_[0])};
}

// With x = a . b and y = a . c, the derivatives of atan2(y, x) are (-y, x)/(x^2 + y^2), and so on.
JointCoordinate::Expansion JointCoordinate::expand_turn(const Eigen::Matrix3Xd& p) const {
  const double x = value_of(products_[0], p), y = value_of(products_[1], p), square = x * x + y * y;
  const Vector of_x = slope_of(products_[0], p), of_y = slope_of(products_[1], p);
  const Eigen::MatrixXd xy = of_x * of_y.transpose();
  const Eigen::MatrixXd mixed =
      2 * x * y * (of_x * of_x.transpose() - of_y * of_y.transpose()) + (y * y - x * x) * (xy + xy.transpose());
  return {std::atan2(y, x), (x * of_y - y * of_x) / square,
          (x * curvature_of(products_[1]) - y * curvature_of(products_[0])) / square + mixed / (square * square)};
}

// With x = r . r and l = sqrt(x), l' = x'/(2 l) and l'' = (x''/2 - l' l')/l.
JointCoordinate::Expansion JointCoordinate::expand_stretch(const Eigen::Matrix3Xd& p) const {
  const double length = std::sqrt(value_of(products_[0], p));
  if (!(length > 0)) throw RecoverableError("the points of a strut coincide, so that its force has no direction");
  const Vector slope = slope_of(products_[0], p) / (2 * length);
  return {length - length_at_rest(), slope, (curvature_of(products_[0]) / 2 - slope * slope.transpose()) / length};
}

}  // namespace orthodyn
