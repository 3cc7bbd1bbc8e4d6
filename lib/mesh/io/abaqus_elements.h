// *ELEMENT of an Abaqus input file: solid elements, faces, and elements that are ignored.
//
// Source: Abaqus keywords reference, *ELEMENT.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lib/mesh/io/abaqus_sets.h"
#include "lib/mesh/io/abaqus_types.h"

namespace orthodyn {

class AbaqusElementReader {
 public:
  // All arguments must outlive the reader.
  AbaqusElementReader(AbaqusLines& lines, AbaqusScopes& scopes, AbaqusSetReader& sets, AbaqusFile& file)
      : lines_(lines), scopes_(scopes), sets_(sets), file_(file) {}

  // Reads the data lines of an *ELEMENT into the file and into the set of its ELSET. Throws ConfigError.
  void read(const AbaqusKeyword& keyword);

  // The number of ignored elements by type.
  const std::map<std::string, std::size_t>& ignored() const { return ignored_; }

 private:
  void ignore(const std::string& type, const std::string& set);
  void read_element(const AbaqusShape& shape, const std::string& type, const std::string& set);
  void add_cell(std::int64_t tag, const AbaqusShape& shape, FilePlace place);
  void add_face(std::int64_t tag, const AbaqusShape& shape, FilePlace place);

  AbaqusLines& lines_;
  AbaqusScopes& scopes_;
  AbaqusSetReader& sets_;
  AbaqusFile& file_;
  std::map<std::string, std::size_t> ignored_;
  std::vector<std::int64_t> nodes_;  // of the current element
};

}  // namespace orthodyn
