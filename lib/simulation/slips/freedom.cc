// Bodies that nothing holds: loads that carry them away, grounds that they begin in.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "lib/simulation/slips/subject.h"

namespace orthodyn::slip {

namespace {

constexpr double kFarAway = 100;  // lengths of the body
constexpr double kInside = 0.1;   // of the body's length, below the ground at the start

Vec3 total_load(const Subject& subject, double t) {
  const auto& parts = subject.built.model->parts();
  const NodalExpansion nodal(parts, t, subject.built.initial.q, Vector::Zero(subject.built.model->num_dofs()));
  NodalVector f = NodalVector::Zero(3, nodal.x.cols());
  for (std::size_t k = subject.scene.gravity ? 1 : 0; k < parts.loads.size(); ++k)
    parts.loads[k]->add_force(nodal.state(), f);
  return f.rowwise().sum();
}

double total_mass(const FemModel& model) {
  const Vector ones = Vector::Ones(model.num_dofs());
  Vector weighted(model.num_dofs());
  model.multiply_mass(ones, weighted);
  return weighted.sum() / 3;
}

// Where the loads alone take the centre of mass, from rest, m; gravity is left out: things may fall.
double carried_away(const Subject& subject) {
  Vec3 way = Vec3::Zero(), speed = way, before = way;
  double farthest = 0, last = subject.start();
  visit_times(subject, [&](double t) {
    const double h = t - last;
    const Vec3 now = total_load(subject, t);
    way += h * speed + h * h / 6 * (2 * before + now);
    speed += h / 2 * (before + now);
    before = now;
    last = t;
    farthest = std::max(farthest, way.norm());
  });
  return farthest / total_mass(*subject.built.model);
}

void add_drift_slip(const Subject& subject, Warnings& out) {
  const Scene& scene = subject.scene;
  if (!subject.moves() || subject.held() || scene.loads.empty() || !scene.terms.empty() || !scene.motions.empty())
    return;
  const double way = carried_away(subject);
  if (way > kFarAway * subject.extent)
    out.push_back(fmt::format("{}: nothing holds the body, and they carry it {:.3g} m away until {:.4g} s, {:.0f} "
                              "times its length: is a clamp missing?", subject.config.at("loads").where(), way,
                              subject.end(), way / subject.extent));
}

void add_ground_slips(const Subject& subject, Warnings& out) {
  if (subject.is_static() || !subject.config.has("terms")) return;
  const FemModel& model = *subject.built.model;
  const NodalExpansion nodal(model.parts(), subject.start(), subject.built.initial.q,
                             Vector::Zero(model.num_dofs()));
  const Config terms = subject.config.at("terms");
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Config term = terms.at(i);
    if (!term.has("type") || term.at("type").text() != "ground") continue;
    const auto given = [&](const char* key, const Vec3& usual, const char* unit) {
      return term.has(key) ? Value<Vec3>::read(term.at(key), {.unit = unit}) : usual;
    };
    const Vec3 point = given("point", Vec3::Zero(), "m"), normal = given("normal", Vec3::UnitZ(), "").normalized();
    const Eigen::RowVectorXd depth = -(normal.transpose() * (nodal.x.colwise() - point));
    if (depth.maxCoeff() < kInside * subject.extent) continue;
    out.push_back(fmt::format("{}: the body begins {} the ground, {:.3g} m deep, and is thrown out of it: is 'point' "
                              "in m and on the ground, and does 'normal' point away from the ground?",
                              term.where(), depth.minCoeff() > 0 ? "below" : "partly in", depth.maxCoeff()));
  }
}

}  // namespace

void add_freedom_slips(const Subject& subject, Warnings& out) {
  add_drift_slip(subject, out);
  add_ground_slips(subject, out);
}

}  // namespace orthodyn::slip
