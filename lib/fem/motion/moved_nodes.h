// The nodes whose motion is prescribed. They are no part of the system: it sees their displacements and
// velocities through the forces of elements and, with a consistent mass, their accelerations.
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

  // rest: the positions of all nodes.
  MovedNodes(std::vector<Part> parts, const NodalVector& rest);

  // Overwrites the moved coordinates.
  void place(double t, NodalVector& u, NodalVector& v) const;
  // Zero for all others; m/s^2.
  NodalVector accelerations(double t) const;
  std::size_t num_coordinates() const;
  std::vector<double> breakpoints(double start, double end) const;
  StepLimits step_limits(double start, double end) const;
  std::size_t bytes() const;

 private:
  std::vector<Part> parts_;
  std::vector<NodalVector> rest_;  // of each part's nodes
  Eigen::Index num_nodes_;
};

}  // namespace orthodyn
