#include "lib/element/wedge15.h"
#include "lib/fem/element_type_of.h"

namespace orthodyn {

const ElementType& quadratic_wedge() {
  static const ElementTypeOf<Wedge15> type;
  return type;
}

}  // namespace orthodyn
