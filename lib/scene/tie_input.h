// The section `ties`: surfaces of bodies that are glued together, whose meshes need not match (lib/fem/ties/mortar.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/config/spec.h"
#include "lib/fem/fem_model.h"
#include "lib/fem/ties/ties.h"
#include "lib/mesh/mesh.h"

namespace orthodyn {

struct TieInput {
  std::string name;             // empty: tie_1 and so on
  std::string first, second;    // surfaces
  std::optional<double> reach;  // m
  SourceLocation origin;
  static const Spec<TieInput>& spec();
};

struct Supports;

struct TiedSurfaces {
  Ties ties;
  std::vector<NamedTie> named;
};

// The ties of the mesh, those within rigid bodies included. The tied nodes of surfaces are moved to the second
// surfaces. Throws ConfigError if surfaces do not lie on each other. Adds a warning if a part of a first surface has no
// counterpart, or if a node is moved visibly.
TiedSurfaces make_ties(const std::vector<TieInput>& inputs, const std::vector<RigidBody>& rigid, Mesh& mesh,
                       Warnings& warnings);

// Tied nodes are held by their leaders: takes them out of the supports, and marks them as held. Throws ConfigError if a
// clamped or moved node has leaders that are not held in the same way.
void release_tied_nodes(const std::vector<TieInput>& inputs, const TiedSurfaces& tied, const Mesh& mesh,
                        Supports& supports);

}  // namespace orthodyn
