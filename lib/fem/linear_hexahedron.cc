#include "lib/element/hex8.h"
#include "lib/fem/element_type_of.h"

namespace orthodyn {

const ElementType& linear_hexahedron() {
  static const ElementTypeOf<Hex8> type;
  return type;
}

}  // namespace orthodyn
