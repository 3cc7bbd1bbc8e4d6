#include "lib/element/hex20.h"
#include "lib/fem/element_type_of.h"

namespace orthodyn {

const ElementType& quadratic_hexahedron() {
  static const ElementTypeOf<Hex20> type;
  return type;
}

}  // namespace orthodyn
