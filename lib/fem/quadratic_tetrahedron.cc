#include "lib/element/tet10.h"
#include "lib/fem/element_type_of.h"

namespace orthodyn {

const ElementType& quadratic_tetrahedron() {
  static const ElementTypeOf<Tet10> type;
  return type;
}

}  // namespace orthodyn
