// Springs, stops and friction of a joint: forces along its coordinate c (joint_coordinate.h), in N or N m,
//
//     -k (c - c0) - d c'                       spring with damping
//     -k psi'(c - high) + k psi'(low - c)      stops, with the smooth penalty psi of contact (contact/penalty.h)
//     -F c' / sqrt(c'^2 + creep^2)             friction
//
// that act on the nodes by dc/dx: they have no resultant and no torque. Tangents leave out the change of the damping
// and the friction force by the change of c' with the places.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "lib/fem/coordinate_nodes.h"
#include "lib/fem/term.h"

namespace orthodyn {

// Units: c in m or rad, forces in N or N m.
struct JointLaw {
  struct Spring {
    double stiffness = 0, damping = 0, rest = 0;
  };
  struct Stop {
    std::optional<double> low, high;
    double stiffness = 0, onset = 0;
  };
  struct Friction {
    double limit = 0, creep = 0;
  };
  std::optional<Spring> spring;
  std::optional<Stop> stop;
  std::optional<Friction> friction;

  bool acts() const { return spring || stop || friction; }
  bool dissipates() const { return friction || (spring && spring->damping > 0); }
  double energy(double c) const;
  // -d energy/dc, and the second derivative of the energy.
  double force(double c) const;
  double stiffness(double c) const;
  // The force by the rate, which is not positive at a positive rate, and its negative derivative by the rate.
  double resistance(double rate) const;
  double damping(double rate) const;
};

std::unique_ptr<Term> joint_forces_term(std::string joint, JointCoordinate coordinate, const JointLaw& law,
                                        const BlockPattern& pattern);

}  // namespace orthodyn
