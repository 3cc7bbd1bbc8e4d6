// Material axes at a point, from YAML; the message if the YAML is refused.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "lib/material_axes/axes_source.h"
#include "tests/config/messages.h"
#include "tests/material/constants.h"

namespace orthodyn {

inline std::shared_ptr<const AxesSource> axes_source(const std::string& yaml) {
  return Registry<AxesSource>::read(Config::from_text("axes: " + yaml, "a.yaml").at("axes"));
}

inline Mat3 axes_at(const std::string& yaml, const Vec3& centroid = Vec3::Zero(), int element = 0) {
  const auto source = axes_source(yaml);
  Warnings notes;
  return source->field(Mesh{}, notes)(centroid, element);
}

inline Warnings notes_of(const std::string& yaml) {
  Warnings notes;
  axes_source(yaml)->field(Mesh{}, notes);
  return notes;
}

inline std::string axes_refusal(const std::string& yaml) {
  return refusal([&] { axes_source(yaml); });
}

// Deviation of Q from a rotation.
inline double improper(const Mat3& Q) {
  return (Q.transpose() * Q - Mat3::Identity()).cwiseAbs().maxCoeff() + std::abs(Q.determinant() - 1);
}

inline std::string yaml_of(const Vec3& v) { return Value<Vec3>::yaml(v); }
inline std::string yaml_of(const Mat3& m) { return Value<Mat3>::yaml(m); }

}  // namespace orthodyn
