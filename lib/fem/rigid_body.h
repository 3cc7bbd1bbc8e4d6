// Rigid bodies. All nodes of a rigid body follow four of them, its frame, as in an affine motion: the weights of a node
// are its barycentric coordinates in the tetrahedron of the frame at rest. The six distances within the frame are
// constraints (joints.h), which make the motion rigid.
//
// So a body has twelve unknowns and six constraints, whatever the number of its nodes. Its mass matrix is constant, and
// no angle is singular. Source: "natural coordinates", Garcia de Jalon & Bayo, Kinematic and Dynamic Simulation of
// Multibody Systems, 1994.
//
// The mass is that of the mesh, or is given. Then the frame has the mass matrix, with the weights N_a of its nodes,
//
//     M_ab = integral of rho N_a N_b dV = m N_a(c) N_b(c) + grad N_a . E grad N_b
//
// with the mass m, its centre c and Euler's tensor E about the centre. M is positive definite if E is.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "lib/fem/joints.h"
#include "lib/fem/mass.h"
#include "lib/fem/ties/ties.h"
#include "lib/mesh/mesh.h"

namespace orthodyn {

struct RigidInertia {
  double mass = 0;             // kg
  Vec3 center = Vec3::Zero();  // m, at rest
  Mat3 moments =
      Mat3::Zero();  // about the centre, in space axes at rest: J = integral of rho (r.r I - r r^T) dV, kg m^2

  // Euler's tensor, integral of rho r r^T dV = trace(J)/2 I - J, kg m^2.
  Mat3 euler() const { return moments.trace() / 2 * Mat3::Identity() - moments; }
  // Eigenvalues of `moments`, ascending, kg m^2.
  Vec3 principal_moments() const;
  // Makes this the inertia of both bodies together.
  void add(const RigidInertia& other);
};

struct RigidBody {
  std::string name;
  std::string place;  // in the input, for messages
  std::array<int, 4> frame;
  std::vector<TiedNode> followers;       // all other nodes
  bool is_held = false;                  // by a clamp or a motion of its frame
  std::vector<RigidInertia> given = {};  // of its regions of given inertia, whose cells have no mass
  RigidInertia inertia = {};             // of the whole body, by the mesh and by `given`; set by add_inertia()

  // All nodes of the body: first the four nodes of the frame, then the followers.
  std::vector<int> nodes() const;
  // Whether all of these nodes are nodes of the body.
  bool contains(const std::vector<int>& some) const;
  // The six distances of the frame.
  Joint rigidity(const Mesh& mesh) const;
  // The mass matrix of the frame by the given inertia.
  FrameMass frame_mass(const Mesh& mesh) const;
  // The mean of the frame's nodes that lies at `point` (m) at rest.
  JointPoint point(const Mesh& mesh, const Vec3& point) const;
};

// The body of these nodes. The frame is a tetrahedron of large volume. Throws ConfigError if the nodes lie in a plane.
RigidBody rigid_body(const Mesh& mesh, const std::vector<int>& nodes, std::string name, std::string place);

// Computes RigidBody::inertia, which must be empty: the sum of the body's cells, by the density of each cell (kg/m^3),
// and of its given inertias.
void add_inertia(const Mesh& mesh, const std::vector<double>& density, std::vector<RigidBody>& bodies);

// Whether the body's motion is known from these nodes: whether three of them are not on a line.
bool spans_plane(const Mesh& mesh, const std::vector<int>& nodes);

}  // namespace orthodyn
