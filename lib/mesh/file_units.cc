#include "lib/mesh/file_units.h"

#include "lib/mesh/io/mesh_file.h"

namespace orthodyn {

void convert_to_si(LoadedMesh& loaded, FileUnits units, const std::string& source) {
  if (units == FileUnits::si) return;
  const UnitFactors factors = factors_of(units);
  scale_mesh(loaded.mesh, factors.length, source);
  for (auto& [region, m] : loaded.materials) {
    m.density *= factors.density;
    m.young *= factors.stress;
    for (double* modulus : {&m.g12, &m.g23, &m.g31}) *modulus *= factors.stress;
    for (double& entry : m.stiffness) entry *= factors.stress;
  }
}

}  // namespace orthodyn
