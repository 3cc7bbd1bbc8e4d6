// A load along the coordinate c of a joint (joint_coordinate.h): the force F(t) = amount factor(t) (N), or the torque
// (N m), of the second body, or of a point in space, on the first one. It acts on the nodes by F dc/dx, without
// resultant and torque of both bodies together, and has the power F c'.
#pragma once

#include <memory>
#include <string>

#include "lib/fem/coordinate_nodes.h"
#include "lib/fem/term.h"
#include "lib/fem/time_functions/time_function.h"

namespace orthodyn {

std::unique_ptr<Term> joint_load_term(std::string joint, JointCoordinate coordinate, double amount,
                                      std::shared_ptr<const TimeFunction> factor, const BlockPattern& pattern);

}  // namespace orthodyn
