// Source of the material axes of a region, chosen by `axes: {type: ...}` from Registry<AxesSource>.
#pragma once

#include <functional>

#include "lib/config/registry.h"
#include "lib/fem/element_axes.h"
#include "lib/fem/element_mesh.h"
#include "lib/mesh/mesh.h"

namespace orthodyn {

// Material axes at a point (m) of the rest shape in the element with this index: a rotation with the columns 1, 2, 3.
using AxesField = std::function<Mat3(const Vec3& point, int element)>;

class AxesSource {
 public:
  virtual ~AxesSource() = default;

  // True if the axes are the same everywhere.
  virtual bool uniform() const { return false; }

  // Adds a sentence to `notes` for each change of the input. The source must outlive the field. Throws ConfigError if
  // the input does not match the mesh.
  virtual AxesField field(const Mesh& mesh, Warnings& notes) const = 0;
};

// The axes at the integration points of the elements `cells`, which are of one type.
ElementAxes element_axes(const AxesSource& source, const AxesField& field, const ElementType& type,
                         const ElementMesh& mesh, const std::vector<int>& cells);

}  // namespace orthodyn
