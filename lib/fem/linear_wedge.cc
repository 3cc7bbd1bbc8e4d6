#include "lib/element/wedge6.h"
#include "lib/fem/element_type_of.h"

namespace orthodyn {

const ElementType& linear_wedge() {
  static const ElementTypeOf<Wedge6> type;
  return type;
}

}  // namespace orthodyn
