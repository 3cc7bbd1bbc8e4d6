// Surfaces that push each other, or a plane, back: the part of a contact term that others ask for.
#pragma once

#include <limits>

namespace orthodyn {

struct NodalState;

class Contact {
 public:
  virtual ~Contact() = default;

  // The distance (m) over which the force changes, if one node takes up this energy (J): positions need to be exact to
  // a small part of it.
  virtual double range(double energy) const = 0;

  // Model::longest_step() of this contact.
  virtual double longest_step(const NodalState&) const { return std::numeric_limits<double>::infinity(); }

  // The depth (m) of a penalty of the same stiffness that has the largest pressure of a node. 0 for a plane.
  virtual double pressed_depth(const NodalState&) const { return 0; }

  // Whether faces with four corners and four nodes in the middle of edges are in contact.
  virtual bool has_faces_of_eight_nodes() const = 0;
};

}  // namespace orthodyn
