// Factors in time of a scene's loads and motions, by the AMPLITUDE= of an Abaqus input file's conditions.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "lib/mesh/io/abaqus_file.h"

namespace orthodyn {

class AbaqusFactors {
 public:
  // Must outlive this.
  explicit AbaqusFactors(const AbaqusAmplitudes& amplitudes) : amplitudes_(amplitudes) {}

  // Why the amplitude of a condition of the first step cannot be taken; "" where it can, and where there is none.
  std::string problem(const AbaqusCondition& condition) const;

  // YAML of a table, which is constant beyond its ends as an amplitude is; "" for conditions without amplitude.
  // Precondition: no problem.
  std::string take(const AbaqusCondition& condition);

  bool any_taken() const { return !taken_.empty(); }
  std::vector<std::string> not_taken() const;  // "*AMPLITUDE Pulse (line 12): nothing that is taken has it"

 private:
  const AbaqusAmplitudes& amplitudes_;
  std::set<std::string> taken_;  // names in capitals
};

}  // namespace orthodyn
