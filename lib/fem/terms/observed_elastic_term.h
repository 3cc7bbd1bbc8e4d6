// The elastic term of a region whose stress is observed together with that of added terms (added_term.h), which are
// separate terms of the model. All other functions are those of the elastic term; or, if another law replaces the
// elastic one, force, energy and stress are those of that law's term, and the elastic term serves for strains and axes
// only.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lib/fem/terms/added_term.h"
#include "lib/fem/terms/elastic_term.h"

namespace orthodyn {

class ObservedElasticTerm final : public ElasticTerm {
 public:
  // The added terms must outlive this object. `replacing`: the term of the law that replaces the elastic one; null for
  // none.
  ObservedElasticTerm(std::unique_ptr<ElasticTerm> elastic, std::vector<const AddedTerm*> added,
                      std::unique_ptr<AddedTerm> replacing)
      : elastic_(std::move(elastic)), added_(std::move(added)), replacing_(std::move(replacing)) {}

  std::string name() const override { return elastic_->name(); }
  std::string description() const override;
  std::size_t bytes() const override { return elastic_->bytes() + (replacing_ ? replacing_->bytes() : 0); }
  void add_force(const NodalState& s, NodalVector& f) const override { source().add_force(s, f); }
  void add_mean_force(const NodalState& s0, const NodalState& s1, NodalVector& f) const override {
    source().add_mean_force(s0, s1, f);
  }
  void add_tangent(const NodalState& s, TangentKind kind, double* K, double* D) const override {
    source().add_tangent(s, kind, K, D);
  }
  void add_predicted_tangent(const NodalState& before, const NodalState& s, double* K) const override {
    source().add_predicted_tangent(before, s, K);
  }
  double energy(const NodalState& s) const override { return source().energy(s); }
  double dissipation(const NodalState& s) const override { return source().dissipation(s); }

  const ElasticRegion& definition() const override { return elastic_->definition(); }
  std::string law() const override { return replacing_ ? replacing_->law() : elastic_->law(); }
  std::vector<const AddedTerm*> added() const override { return added_; }
  bool is_replaced() const override { return replacing_ != nullptr; }
  bool has_energy() const override { return elastic_->has_energy(); }
  int size() const override { return elastic_->size(); }
  int cell(int k) const override { return elastic_->cell(k); }
  const ElementType& type() const override { return elastic_->type(); }
  int num_points() const override { return elastic_->num_points(); }
  Eigen::Matrix<double, 6, Eigen::Dynamic> strains(const NodalState& s) const override { return elastic_->strains(s); }
  double largest_green_strain(const NodalState& s) const override { return elastic_->largest_green_strain(s); }
  Mat3 axes_at_rest(int k, int p) const override { return elastic_->axes_at_rest(k, p); }
  Mat3 small_strain(int k, int p, const NodalVector& u) const override { return elastic_->small_strain(k, p, u); }
  double det_F(int k, const NodalState& s) const override { return elastic_->det_F(k, s); }
  SmallestDetF smallest_det_F(const NodalState& s) const override { return elastic_->smallest_det_F(s); }
  double max_frequency_squared(double density) const override { return elastic_->max_frequency_squared(density); }

  // With the stresses of the added terms; observe() has the mean stress over the element's volume.
  PointObservation observe(int k, const NodalState& s) const override;
  PointObservation observe_point(int k, int p, const NodalState& s) const override;
  std::vector<PointObservation> observe_element(int k, const NodalState& s) const override;
  void observe_points(const NodalState& s, const VisitPoint& visit) const override;
  Eigen::Matrix<double, 6, Eigen::Dynamic> stresses(const NodalState& s) const override;

 private:
  const Term& source() const { return replacing_ ? static_cast<const Term&>(*replacing_) : *elastic_; }
  std::vector<const AddedTerm*> observed() const;
  PointObservation own(PointObservation observation) const;

  std::unique_ptr<ElasticTerm> elastic_;
  std::vector<const AddedTerm*> added_;
  std::unique_ptr<AddedTerm> replacing_;
};

}  // namespace orthodyn
