#include "lib/element/wedge18.h"
#include "lib/fem/element_type_of.h"

namespace orthodyn {

const ElementType& biquadratic_wedge() {
  static const ElementTypeOf<Wedge18> type;
  return type;
}

}  // namespace orthodyn
