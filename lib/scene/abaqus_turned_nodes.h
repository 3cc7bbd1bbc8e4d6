// The nodes at which a *TRANSFORM of an Abaqus input file turns the directions of displacements and forces.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "lib/mesh/io/abaqus_file.h"

namespace orthodyn {

class AbaqusTurnedNodes {
 public:
  // `mesh`: that of the same file.
  AbaqusTurnedNodes(const AbaqusFile& deck, const TetMesh& mesh);

  // Says which *TRANSFORM turns the directions at nodes of a set, and at how many; "" where none does.
  std::string reason(const std::vector<int>& nodes) const;

 private:
  struct Turned {
    int line;
    bool all;  // the file has no such set, so that any node may be meant
    std::set<int> nodes;
  };
  std::vector<Turned> turned_;  // without those that are the identity
};

}  // namespace orthodyn
