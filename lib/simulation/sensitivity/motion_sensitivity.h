// The sensitivities of a scene's motion with respect to numbers of the scene, for integrators
// (lib/ode/sensitivity_equations.h), and the derivatives of outputs that follow from them.
//
// K s + D s' is computed with the tangent, which is assembled once per state of the motion. Where the tangent is not
// the derivative of the force, it is the difference of two forces along (s, s'): stiffness-proportional damping of a
// body with large rotations turns with the body; following loads and the warped force have unsymmetric derivatives.
// df/dp and dM/dp are differences between changed models at the same state (changed_models.h). No motion of a changed
// scene is computed.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lib/ode/sensitivity_equations.h"
#include "lib/simulation/sensitivity/changed_models.h"

namespace orthodyn {

// Whether the scene is a motion whose integrator, named in `config`, computes the derivatives with respect to these
// parameters: without contact, stops, joints that hold and rigid regions, and without numbers of factors in time and of
// kinks. False for `auto`, which would choose another method than without sensitivities.
bool has_motion_sensitivity(const Config& config, const Scene& scene, const std::vector<std::string>& paths);

class MotionSensitivity final : public SensitivityEquations {
 public:
  // `config`: resolved input of `scene` and `built`, in which no kinematics are `auto`. The model must outlive this
  // object. Throws ConfigError at `origin` for contact and constraints, for a parameter that changes the connections of
  // the mesh or the times at which loads have kinks, and for one that is not part of the model. Throws RunError if the
  // motion starts from an equilibrium whose stiffness is singular.
  MotionSensitivity(const Config& config, const Scene& scene, const BuiltScene& built,
                    const std::vector<std::string>& paths, const SourceLocation& origin);

  const std::vector<SceneParameter>& parameters() const { return parameters_; }

  int count() const override { return static_cast<int>(parameters_.size()); }
  // 10 % of the parameter; 10 degrees of an angle.
  double scale(int i) const override { return 10 * parameter(i).usual_change(); }
  const State& initial(int i) const override { return initial_[static_cast<std::size_t>(i)]; }
  void force(int i, double t, const ConstVectorRef& q, const ConstVectorRef& v, const ConstVectorRef& a,
             const ConstVectorRef& s, const ConstVectorRef& s_dot, VectorRef out) override;

  // Replaces the derivative of the initial state, to go on with an interrupted integration.
  void set_initial(int i, State slope) { initial_[static_cast<std::size_t>(i)] = std::move(slope); }

  // The derivative of outputs with respect to parameter i, per SI unit. `slope`: the derivative of the state.
  Eigen::VectorXd derivative(int i, const State& state, const State& slope, const SceneOutputs& outputs) const;

 private:
  const SceneParameter& parameter(int i) const { return parameters_[static_cast<std::size_t>(i)]; }
  const ChangedModels& changed(int i) const { return changed_[static_cast<std::size_t>(i)]; }
  State initial_derivative(int i, const Config& config, const State& start) const;
  // K s + D s'.
  void tangential_force(const ConstVectorRef& s, const ConstVectorRef& s_dot, VectorRef out) const;
  void move_to(double t, const ConstVectorRef& q, const ConstVectorRef& v, const ConstVectorRef& a);
  Vector residual(const FemModel& model, double t, const ConstVectorRef& q, const ConstVectorRef& v,
                  const ConstVectorRef& a) const;

  const Scene scene_;
  const FemModel& model_;
  const double small_;      // displacement that is small beside the body, m
  const bool has_tangent_;  // whether K and D are the derivatives of the force
  std::vector<SceneParameter> parameters_;
  std::vector<ChangedModels> changed_;
  std::vector<State> initial_;

  // Derivatives at one state.
  struct At {
    double t = 0;
    Vector q, v, a;
    Linearization tangent;
    std::vector<double> stiffness, damping;  // entries of K and D; D empty if it is 0
    std::vector<Vector> partial;             // g of each parameter; empty: not yet computed
  };
  At at_;
};

}  // namespace orthodyn
