// Material axes of elements by *ORIENTATION and *DISTRIBUTION.
//
// Source: Abaqus keywords reference, *ORIENTATION; CalculiX manual, *DISTRIBUTION.
#pragma once

#include <functional>
#include <vector>

#include "lib/mesh/io/abaqus_file.h"

namespace orthodyn {

class AbaqusAxes {
 public:
  using Use = std::function<void(std::size_t cell)>;
  using EachElement = std::function<void(const AbaqusMembers&, const Use&)>;
  using Position = std::function<Vec3(std::int64_t node)>;

  // `each` calls its argument for the members among the file's solid elements. The file and the orientation must
  // outlive this. Throws ConfigError for a distribution that there is not or whose rows are of another kind.
  AbaqusAxes(const AbaqusFile& file, const AbaqusOrientation& orientation, const EachElement& each,
             const Position& position);

  // Columns are axes 1, 2, 3 of an element with this centre. Throws ConfigError where the points do not say.
  Mat3 of(std::size_t cell, const Vec3& centre) const;

 private:
  // Rows of a distribution, and which of them each element has.
  struct ByElement {
    const AbaqusDistribution* distribution = nullptr;
    std::vector<int> row;
  };
  ByElement by_element(const std::string& name, std::size_t count, const EachElement& each) const;
  const std::array<double, 6>& values(const ByElement& listed, std::size_t cell) const;
  Mat3 frame(const std::array<Vec3, 3>& points, const Vec3& centre, std::size_t cell) const;
  [[noreturn]] void fail(std::size_t cell, const char* what) const;

  const AbaqusFile& file_;
  const AbaqusOrientation& orientation_;
  std::array<Vec3, 3> points_;
  ByElement points_of_, angle_of_;
};

}  // namespace orthodyn
