// The coordinate of a joint: how far the first body has moved along the line of the second one (m), or turned about it
// (rad, by the right-hand rule), or how much the distance of a point of each body has changed (m), since the rest
// shape.
#pragma once

#include <vector>

#include "lib/fem/joint_point.h"

namespace orthodyn {

class JointCoordinate {
 public:
  // Distance of `first` along the line of the second body from `from` to `to`: r . s/|s0| with the spans r from `from`
  // to `first` and s from `from` to `to`, whose length at rest is |s0|.
  static JointCoordinate sliding(JointPoint first, JointPoint from, JointPoint to);
  // Angle from -pi to pi of the span a, from `from` to `side` of the first body, towards that of the second body,
  // which are parallel at rest: atan2(a . c, a . b) with the spans b to `second_side` and c to `second_other` of the
  // second body, at right angles to each other and to the line, in the sense of the right-hand rule.
  static JointCoordinate turning(JointPoint from, JointPoint side, JointPoint second_from, JointPoint second_side,
                                 JointPoint second_other);
  // Change of the distance of two points: sqrt(r . r) - |r0| with the span r between them, r0 at rest.
  static JointCoordinate stretching(JointPoint first, JointPoint second);

  bool is_angle() const { return kind_ == Kind::turn; }
  bool is_stretch() const { return kind_ == Kind::stretch; }
  const char* unit() const { return is_angle() ? "rad" : "m"; }
  const std::vector<JointPoint>& points() const { return points_; }

  // Value, and its first and second derivatives by the places of the points, three rows for each.
  struct Expansion {
    double value;
    Vector slope;
    Eigen::MatrixXd curvature;
  };
  double value(const NodalVector& u) const;
  // These two throw RecoverableError where the points of a distance coincide, whose derivatives do not exist there.
  double rate(const NodalVector& u, const NodalVector& v) const;
  Expansion expand(const NodalVector& u) const;

 private:
  enum class Kind { slide, turn, stretch };

  // (sum r_i p_i) . (sum s_i p_i) / scale of the points p_i.
  struct Product {
    Vector r, s;
    double scale;
  };

  JointCoordinate(Kind kind, std::vector<JointPoint> points, std::vector<Product> products)
      : kind_(kind), points_(std::move(points)), products_(std::move(products)) {}
  double length_at_rest() const { return (points_[0].rest - points_[1].rest).norm(); }  // of a stretch, m
  Expansion expand_slide(const Eigen::Matrix3Xd& p) const;
  Expansion expand_turn(const Eigen::Matrix3Xd& p) const;
  Expansion expand_stretch(const Eigen::Matrix3Xd& p) const;
  Eigen::Matrix3Xd places(const NodalVector& u) const;
  double value_of(const Product& product, const Eigen::Matrix3Xd& p) const;
  Vector slope_of(const Product& product, const Eigen::Matrix3Xd& p) const;
  Eigen::MatrixXd curvature_of(const Product& product) const;

  Kind kind_;
  std::vector<JointPoint> points_;
  std::vector<Product> products_;  // the distance, or cosine and sine, or the square of the distance
};

}  // namespace orthodyn
