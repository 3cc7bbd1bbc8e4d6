// *AMPLITUDE of an Abaqus input file: a factor in time that conditions name.
//
// Source: Abaqus keywords reference, *AMPLITUDE; analysis user's guide, "amplitude curves".
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "lib/mesh/io/abaqus_lines.h"

namespace orthodyn {

// Linear between its points, constant before the first and behind the last.
struct AbaqusAmplitude {
  std::string name = {};                           // as spelled
  std::vector<std::array<double, 2>> points = {};  // time (s), factor; times ascend
  std::string problem = {};  // why there are no points: "SMOOTH of *AMPLITUDE Pulse (line 12) is not read"; or ""
  FilePlace place = {};
};

using AbaqusAmplitudes = std::map<std::string, AbaqusAmplitude>;  // by name in capitals

// DEFINITION=TABULAR with relative values. Its times are those of the first step, in which step and total time are the
// same. Everything else is a problem only for those who want the amplitude. Takes the lines of data.
AbaqusAmplitude read_abaqus_amplitude(const AbaqusKeyword& keyword, AbaqusLines& lines);

}  // namespace orthodyn
