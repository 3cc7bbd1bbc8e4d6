// The term of an added law (lib/fem/added_laws) in one region. Made by ElementType::added_term().
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "lib/fem/element_mesh.h"
#include "lib/fem/term.h"

namespace orthodyn {

class AddedTerm : public Term {
 public:
  // Calls visit(k, point, Cauchy stress in space, stress in the turning material axes), in Pa, without the part that
  // depends on the rate of F, as the elastic term observes no viscous stress; for all points of all
  // elements, concurrently for different elements, or for the points of element k. k as in ElasticTerm.
  using VisitStress = std::function<void(int k, int point, const Mat3& cauchy, const Mat3& turned)>;
  virtual void visit_stresses(const NodalState& s, const VisitStress& visit) const = 0;
  virtual void visit_stresses_of(int k, const NodalState& s, const VisitStress& visit) const = 0;
  virtual std::string law() const = 0;                // name of the law
  virtual bool scales_with_stiffness() const = 0;     // AddedLaw::scales_with_stiffness()
  virtual double volume(int k, int point) const = 0;  // m^3, at rest

  // The internal variables (InternalVariables) of all points of the term. num_internal() is 0 for laws that have none;
  // the other functions are then not called. `first`: the index of the term's first variable in vectors of internal
  // variables, which have the entries of all terms of the model.
  virtual Eigen::Index num_internal() const = 0;
  virtual void set_first_internal(Eigen::Index first) = 0;
  virtual void get_relaxation_times(Vector& times) const = 0;
  virtual void get_strains(const NodalState& s, VectorRef strains) const = 0;
  virtual void get_total_strains(const NodalState& s, VectorRef strains) const = 0;
  virtual void get_strain_change(const NodalState& s, const NodalVector& du, VectorRef change) const = 0;
  // As InternalVariables::add_peak_force().
  virtual void add_internal_peak_force(const NodalState& s, double end, NodalVector& f) const = 0;
  // Adds the change of the force for a change of the internal variables.
  virtual void add_force_change(const NodalState& s, const Vector& change, NodalVector& f) const = 0;

  // This term with corotational kinematics; the arguments are those of ElementType::added_term().
  virtual std::unique_ptr<AddedTerm> corotational(const ElementMesh& mesh, const BlockPattern& pattern) const = 0;
};

}  // namespace orthodyn
