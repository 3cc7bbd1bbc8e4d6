// Material axes of elements from *ORIENTATION and *DISTRIBUTION.
//
// Source: Abaqus keywords reference, *ORIENTATION; CalculiX manual, *DISTRIBUTION.
#pragma once

#include <vector>

#include "lib/mesh/io/abaqus_lookup.h"

namespace orthodyn {

class AbaqusAxes {
 public:
  // `file` and `orientation` must outlive the axes. Throws ConfigError for a distribution that is not defined, or whose
  // rows do not have the kind of values that the orientation needs.
  AbaqusAxes(const AbaqusFile& file, const AbaqusOrientation& orientation, AbaqusLookup& lookup);

  // Rotation whose columns are axes 1, 2, 3 of a cell with this centre (m). Throws ConfigError where the points of the
  // orientation do not determine the axes.
  Mat3 of(std::size_t cell, const Vec3& centre) const;

 private:
  // A distribution and the row of each cell, -1 for none.
  struct ByElement {
    const AbaqusDistribution* distribution = nullptr;
    std::vector<int> row;
  };
  ByElement by_element(const std::string& name, std::size_t count, AbaqusLookup& lookup) const;
  const std::array<double, 6>& values(const ByElement& listed, std::size_t cell) const;
  Mat3 frame(const std::array<Vec3, 3>& points, const Vec3& centre, std::size_t cell) const;
  [[noreturn]] void fail(std::size_t cell, const char* what) const;

  const AbaqusFile& file_;
  const AbaqusOrientation& orientation_;
  std::array<Vec3, 3> points_;
  ByElement points_of_, angle_of_;
};

}  // namespace orthodyn
