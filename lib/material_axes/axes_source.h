// Where the material axes of a region come from: one kind per entry of Registry<AxesSource>, each in a
// file of its own.
#pragma once

#include <functional>

#include "lib/config/registry.h"
#include "lib/fem/element_axes.h"
#include "lib/fem/element_mesh.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

// The axes at a point of the rest shape (m) that lies in an element of this index in the mesh: a rotation whose columns
// are the directions 1, 2, 3.
using AxesField = std::function<Mat3(const Vec3& point, int element)>;

class AxesSource {
 public:
  virtual ~AxesSource() = default;

  // Whether the axes are the same everywhere.
  virtual bool uniform() const { return false; }

  // `notes` receives a sentence for whatever of the input was changed. The source must outlive the field.
  // Throws ConfigError if what is given does not fit the mesh.
  virtual AxesField field(const TetMesh& mesh, Warnings& notes) const = 0;
};

// The mean of an element's corners, m.
Vec3 centroid(const TetMesh& mesh, int cell);

// The axes at the integration points of the elements `cells` of a mesh.
ElementAxes element_axes(const AxesSource& source, const AxesField& field, const ElementMesh& mesh,
                         const std::vector<int>& cells);

}  // namespace orthodyn
