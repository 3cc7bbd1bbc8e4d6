#include "lib/material/axes.h"

namespace orthodyn {

const Spec<Axes>& Axes::spec() {
  static const auto s =
      Spec<Axes>()
          .key("first", &Axes::first, "Direction of material axis 1, of any length.")
          .key("second", &Axes::second,
               "Material axis 2 is the part of this direction normal to axis 1; axis 3 = 1 x 2.")
          .check([](const Axes& a, const Config& config) {
            const double area = a.first.stableNormalized().cross(a.second.stableNormalized()).norm();
            if (!(area > 1e-6))
              config.fail("'first' and 'second' are zero or parallel; give two different directions");
          });
  return s;
}

Mat3 Axes::rotation() const {
  Mat3 Q;
  Q.col(0) = first.stableNormalized();
  Q.col(1) = second.stableNormalized();
  for (int twice = 0; twice < 2; ++twice)  // the second time for nearly parallel directions
    Q.col(1) = (Q.col(1) - Q.col(0).dot(Q.col(1)) * Q.col(0)).normalized();
  Q.col(2) = Q.col(0).cross(Q.col(1));
  return Q;
}

}  // namespace orthodyn
