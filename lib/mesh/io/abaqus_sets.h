// *NSET and *ELSET of an Abaqus input file.
//
// Source: Abaqus keywords reference, *NSET, *ELSET.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "lib/mesh/io/abaqus_scopes.h"

namespace orthodyn {

class AbaqusSetReader {
 public:
  // Both must outlive the reader.
  AbaqusSetReader(AbaqusLines& lines, const AbaqusScopes& scopes) : lines_(lines), scopes_(scopes) {}

  // Reads the data lines of an *NSET or *ELSET; `parameter` is the one that names the set. Throws ConfigError.
  void read(const AbaqusKeyword& keyword, const char* parameter, AbaqusSets& sets);

  // The set of this name in the current scope, added if it is new. It becomes the set that was changed last.
  AbaqusSet& touch(const std::string& name, AbaqusSets& sets);

  // Adds members to the set of this name.
  void add(AbaqusMembers members, const std::string& name, AbaqusSets& sets);

 private:
  AbaqusMembers read_range(const std::vector<std::string_view>& fields, std::int64_t offset);

  AbaqusLines& lines_;
  const AbaqusScopes& scopes_;
  int order_ = 0;
};

// Throws ConfigError for a set that contains itself, directly or through other sets, and for sets nested more than 1000
// deep. Code that runs after this check may follow nested sets by recursion.
void check_set_nesting(const AbaqusFile& file);

// The tags of the solid elements of an element set, by its key; empty if there is no such set.
std::set<std::int64_t> solids_of_set(const AbaqusFile& file, const std::string& key);

}  // namespace orthodyn
