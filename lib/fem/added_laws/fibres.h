// The stress of fibres (lib/material/fibres) along material axis 1: the passive tension, and the active one
// activation * stress * f_L(lambda) * f_V(dlambda/dt).
//
// Energy: that of the passive tension is its integral. The active stress without a rate has a potential at fixed
// activation, the integral of activation * stress * f_L from lambda = 0: the work that the fibre would do if it
// shortened to a point. The rate of this potential at a fixed shape is the power that activation supplies. The rest,
// activation * stress * f_L (f_V - 1), has the sign of dlambda/dt and dissipates.
#pragma once

#include <functional>
#include <memory>

#include "lib/fem/added_laws/added_law.h"
#include "lib/fem/added_laws/point_values.h"
#include "lib/fem/terms/elasticity_options.h"
#include "lib/material/fibres/fibres.h"

namespace orthodyn {

// The law of the passive tension. Throws ConfigError for a curve that cannot be read.
std::unique_ptr<AddedLaw> make_passive_fibres(const PassiveFibre& fibre, Kinematics kinematics);

// The activation of the fibres of a region. `refuse` throws a ConfigError for a value outside of [0, 1] at time t (s)
// in an element, counted from 0 within the region.
struct FibreActivation {
  std::shared_ptr<const PointValues> values;
  int points_per_element = 1;
  std::function<void(double t, double value, Eigen::Index element)> refuse;
};

// The law of the active tension, a load. Its function at() throws the ConfigError of FibreActivation::refuse. Throws
// ConfigError for curves that cannot be read.
std::unique_ptr<AddedLaw> make_active_fibres(const ActiveFibre& fibre, Kinematics kinematics,
                                             FibreActivation activation);

}  // namespace orthodyn
