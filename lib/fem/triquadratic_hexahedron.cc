#include "lib/element/hex27.h"
#include "lib/fem/element_type_of.h"

namespace orthodyn {

const ElementType& triquadratic_hexahedron() {
  static const ElementTypeOf<Hex27> type;
  return type;
}

}  // namespace orthodyn
