// Steps of an Abaqus input file with supports, loads, amplitudes and transforms.
//
// Source: Abaqus keywords reference, *STEP, *STATIC, *DYNAMIC, *BOUNDARY, *CLOAD, *DLOAD, *DSLOAD, *AMPLITUDE,
// *TRANSFORM; analysis user's guide, "amplitude curves", "transformed coordinate systems".
#pragma once

#include <map>
#include <string>

#include "lib/mesh/io/abaqus_scopes.h"

namespace orthodyn {

class AbaqusHistoryReader {
 public:
  // All arguments must outlive the reader.
  AbaqusHistoryReader(AbaqusLines& lines, const AbaqusScopes& scopes, AbaqusFile& file)
      : lines_(lines), scopes_(scopes), file_(file) {}

  // Reads a keyword of the history and its data lines into the file. Ignores other keywords. Throws ConfigError.
  void read(const AbaqusKeyword& keyword);

 private:
  void read_period();
  void read_conditions(const AbaqusKeyword& keyword);
  // Sets the target of the condition. Returns false if the members were merged into an earlier condition with the same
  // fields. `made`: keys of the sets created for this keyword, by fields.
  bool set_target(AbaqusCondition& condition, const AbaqusMembers& members, std::map<std::string, std::string>& made);

  AbaqusLines& lines_;
  const AbaqusScopes& scopes_;
  AbaqusFile& file_;
};

}  // namespace orthodyn
