// The rigid bodies of a scene: its regions with the key `rigid` (lib/fem/rigid_body.h).
#pragma once

#include <vector>

#include "lib/fem/rigid_body.h"
#include "lib/scene/region.h"

namespace orthodyn {

struct Supports;

// Rigid regions that share nodes are one body. `regions`: result of assign_regions().
std::vector<RigidBody> rigid_bodies(const std::vector<const Region*>& regions, const Mesh& mesh);

// The mass of the bodies of given inertia.
std::vector<FrameMass> frame_masses(const std::vector<RigidBody>& bodies, const Mesh& mesh);

// A clamp or motion of three nodes of a rigid body that are not on a line holds the whole body: gives it the frame of
// the body. Throws ConfigError if a body is held in another way.
void hold_rigid_bodies(const Scene& scene, const Mesh& mesh, std::vector<RigidBody>& bodies, Supports& supports);

// Throws ConfigError at a free rigid body if the analysis is not dynamic or starts from an equilibrium.
void require_dynamic(const Scene& scene, const std::vector<RigidBody>& bodies);

}  // namespace orthodyn
