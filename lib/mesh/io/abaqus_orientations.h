// *ORIENTATION and *DISTRIBUTION of an Abaqus input file: material axes per section or per element.
//
// Source: Abaqus keywords reference, *ORIENTATION, *DISTRIBUTION, *DISTRIBUTION TABLE.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lib/mesh/io/abaqus_scopes.h"

namespace orthodyn {

class AbaqusOrientationReader {
 public:
  // All arguments must outlive the reader.
  AbaqusOrientationReader(AbaqusLines& lines, const AbaqusScopes& scopes, AbaqusFile& file)
      : lines_(lines), scopes_(scopes), file_(file) {}

  // Reads one of these keywords and its data lines into the file. Returns false for other keywords. Throws ConfigError.
  bool read(const AbaqusKeyword& keyword);

 private:
  void read_orientation(const AbaqusKeyword& keyword);
  void check_points(const AbaqusOrientation& orientation, std::size_t points) const;
  void read_rotation(AbaqusOrientation& out);
  void read_table(const AbaqusKeyword& keyword);
  std::size_t values_per_row(const AbaqusKeyword& keyword) const;
  void read_distribution(const AbaqusKeyword& keyword);

  AbaqusLines& lines_;
  const AbaqusScopes& scopes_;
  AbaqusFile& file_;
  std::map<std::string, std::vector<std::string>> tables_;  // labels of *DISTRIBUTION TABLE, by name in capitals
};

}  // namespace orthodyn
