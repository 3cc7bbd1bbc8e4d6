// A scene of an Abaqus input file: a brick, with more lines behind it.
#pragma once

#include <algorithm>
#include <string>

#include "lib/scene/abaqus_scene.h"
#include "tests/mesh/refusal.h"

namespace orthodyn {

// A brick of sides 2, 3 and 5, with its mesh and material in the lines 1 to 21 of the file.
inline AbaqusScene brick(const std::string& conditions, const AbaqusSceneOptions& options = {.is_static = true}) {
  const TemporaryFolder folder;
  folder.write("a.inp",
               "*NODE\n1, 0, 0, 0\n2, 2, 0, 0\n3, 2, 3, 0\n4, 0, 3, 0\n5, 0, 0, 5\n6, 2, 0, 5\n7, 2, 3, 5\n8, 0, 3, 5\n"
               "*ELEMENT, TYPE=C3D8, ELSET=All\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*NSET, NSET=Foot\n1, 2, 3, 4\n"
               "*SURFACE, NAME=Top\n1, S2\n*MATERIAL, NAME=M\n*ELASTIC\n1000, 0\n*DENSITY\n1\n"
               "*SOLID SECTION, ELSET=All, MATERIAL=M\n" +
                   conditions);
  return scene_of_abaqus(folder.path("a.inp"), "a.inp", options);
}

// Expects that the scene of the brick with these lines lists `what` as left out, also in its text.
inline void expect_left_out(const std::string& conditions, const std::string& what,
                            const AbaqusSceneOptions& options = {.is_static = true}) {
  const AbaqusScene made = brick(conditions, options);
  EXPECT_NE(std::find(made.left_out.begin(), made.left_out.end(), what), made.left_out.end()) << what << "\n"
                                                                                              << made.text;
  EXPECT_CONTAINS(made.text, "#   " + what + "\n");
}

}  // namespace orthodyn
