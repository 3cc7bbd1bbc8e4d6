// Steps of an Abaqus input file, their supports and loads, and the amplitudes and transforms that these name.
//
// Source: Abaqus keywords reference, *STEP, *STATIC, *DYNAMIC, *BOUNDARY, *CLOAD, *DLOAD, *DSLOAD.
#pragma once

#include <map>
#include <string>

#include "lib/mesh/io/abaqus_scopes.h"

namespace orthodyn {

class AbaqusHistoryReader {
 public:
  // All must outlive this.
  AbaqusHistoryReader(AbaqusLines& lines, const AbaqusScopes& scopes, AbaqusFile& file)
      : lines_(lines), scopes_(scopes), file_(file) {}

  // Takes a keyword of the history into the file, with its lines of data. Ignores other keywords. Throws ConfigError.
  void read(const AbaqusKeyword& keyword);

 private:
  void read_period();
  void read_conditions(const AbaqusKeyword& keyword);
  // Gives the condition its target. False if an earlier condition with the same fields takes these numbers, too.
  // `made`: by fields, the keys of sets made for this keyword.
  bool gather(AbaqusCondition& condition, const AbaqusMembers& members, std::map<std::string, std::string>& made);

  AbaqusLines& lines_;
  const AbaqusScopes& scopes_;
  AbaqusFile& file_;
};

}  // namespace orthodyn
