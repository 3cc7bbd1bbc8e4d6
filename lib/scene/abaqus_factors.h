// Time functions of loads and motions from the AMPLITUDE parameters of an Abaqus input file.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "lib/mesh/io/abaqus_file.h"

namespace orthodyn {

class AbaqusFactors {
 public:
  // `amplitudes` must outlive this object.
  explicit AbaqusFactors(const AbaqusAmplitudes& amplitudes) : amplitudes_(amplitudes) {}

  // Why the amplitude of a condition of the first step cannot be converted; "" if it can be, or if the condition has
  // none.
  std::string problem(const AbaqusCondition& condition) const;

  // The condition's amplitude as the YAML of a table, which is constant beyond its ends; "" if the condition has none.
  // The amplitude then counts as taken. Precondition: problem() is "".
  std::string take(const AbaqusCondition& condition);

  bool any_taken() const { return !taken_.empty(); }
  std::vector<std::string> not_taken() const;  // "*AMPLITUDE Pulse (line 12): not used by a converted condition"

 private:
  const AbaqusAmplitudes& amplitudes_;
  std::set<std::string> taken_;  // names in capitals
};

}  // namespace orthodyn
