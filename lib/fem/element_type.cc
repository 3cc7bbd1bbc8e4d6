#include "lib/fem/element_type.h"

#include <stdexcept>

namespace orthodyn {

const ElementType& element_type(CellShape shape) {
  switch (shape) {
    case CellShape::tet4: return linear_tetrahedron();
    case CellShape::tet10: return quadratic_tetrahedron();
    case CellShape::wedge6: return linear_wedge();
    case CellShape::wedge15: return quadratic_wedge();
    case CellShape::wedge18: return biquadratic_wedge();
    case CellShape::hex8: return linear_hexahedron();
    case CellShape::hex20: return quadratic_hexahedron();
    case CellShape::hex27: return triquadratic_hexahedron();
    default: throw std::logic_error(std::string("not a solid cell: ") + topology(shape).name);
  }
}

}  // namespace orthodyn
