#include "lib/fem/element_type.h"

#include "lib/core/errors.h"

namespace orthodyn {

const ElementType& element_type(CellShape shape) {
  switch (shape) {
    case CellShape::tet4: return linear_tetrahedron();
    case CellShape::tet10: return quadratic_tetrahedron();
    case CellShape::wedge15: return quadratic_wedge();
    case CellShape::wedge18: return biquadratic_wedge();
    case CellShape::hex20: return quadratic_hexahedron();
    case CellShape::hex27: return triquadratic_hexahedron();
    default:
      throw ConfigError("mesh", std::string("linear ") + topology(shape).plural +
                                    " cannot be computed; make the mesh quadratic (`order: 2`) or split the cells "
                                    "into tetrahedra");
  }
}

}  // namespace orthodyn
