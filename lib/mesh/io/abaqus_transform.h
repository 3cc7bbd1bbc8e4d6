// *TRANSFORM of an Abaqus input file: other directions of displacements and forces at the nodes of a set.
//
// Source: Abaqus keywords reference, *TRANSFORM; analysis user's guide, "transformed coordinate systems".
#pragma once

#include <string>

#include "lib/core/types.h"
#include "lib/mesh/io/abaqus_lines.h"

namespace orthodyn {

struct AbaqusTransform {
  std::string set = {};      // of nodes, in capitals
  bool is_identity = false;  // its directions are those of space, to 1e-6 rad
  FilePlace place = {};
};

// `R` turns the directions of the instance within which it stands. Takes the lines of data. What is no number gives
// a transform that is not the identity.
AbaqusTransform read_abaqus_transform(const AbaqusKeyword& keyword, const std::string& set, const Mat3& R,
                                      AbaqusLines& lines);

}  // namespace orthodyn
