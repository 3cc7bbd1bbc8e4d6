// The nodes with prescribed motion. They are not unknowns. Their displacements and velocities enter element forces.
// With a consistent mass, their accelerations enter the inertia of free nodes.
#pragma once

#include <array>
#include <memory>

#include "lib/fem/motion/motion.h"

namespace orthodyn {

class MovedNodes {
 public:
  struct Part {
    std::shared_ptr<const Motion> motion;
    std::vector<int> nodes;
    std::array<bool, 3> components;  // which coordinates are moved
  };

  // `rest`: positions of all nodes at rest, m.
  MovedNodes(std::vector<Part> parts, const NodalVector& rest);

  // Sets the moved coordinates of u (m) and v (m/s) at time t.
  void place(double t, NodalVector& u, NodalVector& v) const;
  // Accelerations of all nodes, m/s^2; zero for coordinates that are not moved.
  NodalVector accelerations(double t) const;
  std::size_t num_coordinates() const;
  std::vector<double> breakpoints(double start, double end) const;
  StepLimits step_limits(double start, double end) const;
  std::size_t bytes() const;

 private:
  std::vector<Part> parts_;
  std::vector<NodalVector> rest_;  // per part: positions of its nodes at rest, m
  Eigen::Index num_nodes_;
};

}  // namespace orthodyn
