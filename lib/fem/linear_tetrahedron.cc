#include "lib/element/tet4.h"
#include "lib/fem/element_type_of.h"

namespace orthodyn {

const ElementType& linear_tetrahedron() {
  static const ElementTypeOf<Tet4> type;
  return type;
}

}  // namespace orthodyn
