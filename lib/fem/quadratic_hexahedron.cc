#include "lib/element/hex20.h"
#include "lib/fem/element_type_of.h"

namespace orthodyn {

const ElementType& quadratic_hexahedron() {
  static const ElementTypeOf<Hex20> type;
  return type;
}

const ElementType& quadratic_hexahedron_14() {
  static const ElementTypeOf<Hex20> type(
      {irons_points(), Hex20::nodes(), Hex20::extrapolation(irons_points(), &Hex20::interpolation_14)});
  return type;
}

}  // namespace orthodyn
