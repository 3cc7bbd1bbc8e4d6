// Surfaces that push each other, or a plane, back: the part of a contact term that others ask for.
#pragma once

#include <atomic>
#include <limits>
#include <string>

#include "lib/core/types.h"

namespace orthodyn {

struct NodalState;

class Contact {
 public:
  virtual ~Contact() = default;

  struct Label {
    std::string name = {};   // of its outputs; empty if the input gives none
    std::string place = {};  // in the input, for messages
  };
  virtual const Label& label() const = 0;

  // resultant(): the sum of the forces (N) on the first surface, or on the body that touches a plane. Contact of a
  // surface with itself has no resultant, as the sum of its forces is zero.
  virtual bool has_resultant() const { return true; }
  virtual Vec3 resultant(const NodalState&) const = 0;

  // Whether a force has been evaluated in which points touch.
  bool has_acted() const { return has_acted_.load(std::memory_order_relaxed); }

  // The pressure at the deepest point, or where surfaces are nearest, Pa.
  virtual double largest_pressure(const NodalState&) const = 0;

  // The distance (m) over which the force changes, if one point takes up this energy (J): positions need to be exact to
  // a small part of it.
  virtual double range(double energy) const = 0;

  // Model::longest_step() of this contact.
  virtual double longest_step(const NodalState&) const { return std::numeric_limits<double>::infinity(); }

  // Whether states in which surfaces cross have no force.
  virtual bool refuses_crossing() const { return false; }

  // The largest pressure over the stiffness, m. 0 for a plane.
  virtual double pressed_depth(const NodalState&) const { return 0; }

 protected:
  void note_action() const { has_acted_.store(true, std::memory_order_relaxed); }

 private:
  mutable std::atomic<bool> has_acted_ = false;
};

}  // namespace orthodyn
