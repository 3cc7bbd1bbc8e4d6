// Bodies that nothing holds: loads that carry them away, grounds that they begin in.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lib/fem/surface.h"
#include "lib/mesh/selection.h"
#include "lib/simulation/preflight/input_checks/subject.h"

namespace orthodyn::input_checks {

namespace {

constexpr double kFarAway = 100;  // lengths of the body
constexpr double kInside = 0.02;  // of the body's height over the ground, below it at the start

Vec3 total_load(const Subject& subject, double t) {
  const auto& parts = subject.built.model->parts();
  const NodalExpansion nodal(parts, t, subject.built.initial.q, Vector::Zero(subject.built.model->num_dofs()));
  NodalVector f = NodalVector::Zero(3, nodal.x.cols());
  for (const auto& load : parts.loads)
    if (load->energy_kind() != EnergyKind::gravitational) load->add_force(nodal.state(), f);
  return f.rowwise().sum();
}

double total_mass(const FemModel& model) {
  const Vector ones = Vector::Ones(model.num_dofs());
  Vector weighted(model.num_dofs());
  model.multiply_mass(ones, weighted);
  return weighted.sum() / 3;
}

struct Way {
  double farthest = 0;  // m
  double until = 0;     // s
};

// Where the loads alone take the centre of mass, from rest; gravity is left out: things may fall.
Way carried_away(const Subject& subject) {
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
  return {farthest / total_mass(*subject.built.model), last};
}

// A load that does not end, nor turn around, within the run: a blow does. Loads that hold each other are none together.
// last, N: at the end of the way.
bool is_steady(const Subject& subject, const Vec3& last, double until) {
  constexpr double kNone = 1e-6;
  double largest = 0, smallest_along = last.norm();
  int after_start = 0;
  visit_times(subject, [&](double t) {
    const Vec3 now = total_load(subject, t);
    largest = std::max(largest, now.norm());
    if (t > (subject.start() + subject.end()) / 2) {
      ++after_start;
      smallest_along = std::min(smallest_along, now.dot(last.stableNormalized()));
    }
  });
  const auto& parts = subject.built.model->parts();
  NodalVector f = NodalVector::Zero(3, static_cast<Eigen::Index>(parts.mesh.nodes.size()));
  const NodalExpansion nodal(parts, until, subject.built.initial.q, Vector::Zero(subject.built.model->num_dofs()));
  for (const auto& load : parts.loads)
    if (load->energy_kind() != EnergyKind::gravitational) load->add_force(nodal.state(), f);
  const double held_by_each_other = kNone * f.colwise().norm().sum();
  return after_start > 0 && last.norm() > held_by_each_other && smallest_along > largest / 2;
}

// File and line of the scene's loads and of each of its terms; "" if there are none.
std::string places_of_loads(const Subject& subject) {
  std::string places = subject.scene.loads.empty() ? "" : subject.config.at("loads").where();
  if (!subject.config.has("terms")) return places;
  const Config terms = subject.config.at("terms");
  for (std::size_t i = 0; i < terms.size(); ++i) places += (places.empty() ? "" : ", ") + terms.at(i).where();
  return places;
}

void check_drift(const Subject& subject, Warnings& out) {
  if (!subject.moves() || !is_free(subject)) return;
  const std::string places = places_of_loads(subject);
  if (places.empty()) return;
  const auto [way, until] = carried_away(subject);
  const Vec3 last = total_load(subject, until);
  if (way <= kFarAway * subject.extent && is_steady(subject, last, until))
    out.push_back(
        fmt::format("{}: nothing holds the body, and they push it to the end, with {:.3g} N in all: it is "
                    "carried away ({:.2g} m until {:.4g} s) rather than bent. Is a clamp missing?",
                    places, last.norm(), way, until));
  if (way > kFarAway * subject.extent)
    out.push_back(
        fmt::format("{}: nothing holds the body, and they carry it {:.3g} m away until {:.4g} s, {:.0f} "
                    "times its length: is a clamp missing?",
                    places, way, until, way / subject.extent));
}

// Of the surface that can touch the ground.
std::vector<int> touching_nodes(const Config& term, const TetMesh& mesh) {
  std::optional<std::string> surface;
  if (term.has("surface") && !term.at("surface").is_null()) surface = term.at("surface").text();
  std::vector<int> nodes;
  for (const auto& [node, area] : node_areas(mesh, surface_or_all(mesh, surface, SourceLocation())))
    nodes.push_back(node);
  return nodes;
}

void check_ground(const Subject& subject, Warnings& out) {
  if (subject.is_static() || !subject.config.has("terms")) return;
  const FemModel& model = *subject.built.model;
  const NodalExpansion nodal(model.parts(), subject.start(), subject.built.initial.q, Vector::Zero(model.num_dofs()));
  const Config terms = subject.config.at("terms");
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Config term = terms.at(i);
    if (!term.has("type") || term.at("type").text() != "ground_contact") continue;
    const auto given = [&](const char* key, const Vec3& usual, const char* unit) {
      return term.has(key) ? Value<Vec3>::read(term.at(key), {.unit = unit}) : usual;
    };
    const Vec3 point = given("point", Vec3::Zero(), "m"), normal = given("normal", Vec3::UnitZ(), "").normalized();
    const Eigen::RowVectorXd depth = -(normal.transpose() * (nodal.x.colwise() - point));
    double deepest = 0;
    for (const int node : touching_nodes(term, model.parts().mesh)) deepest = std::max(deepest, depth[node]);
    if (deepest <= kInside * (depth.maxCoeff() - depth.minCoeff())) continue;
    out.push_back(
        fmt::format("{}: the body begins {} the ground, {:.3g} m deep, and is thrown out of it: is 'point' "
                    "in m and on the ground, and does 'normal' point away from the ground?",
                    term.where(), depth.minCoeff() > 0 ? "below" : "partly in", deepest));
  }
}

}  // namespace

bool is_free(const Subject& subject) {
  if (subject.held() || !subject.scene.motions.empty()) return false;
  if (!subject.config.has("terms")) return true;
  static const std::set<std::string> pushing{"point_load", "nodal_forces", "pressure"};
  const Config terms = subject.config.at("terms");
  for (std::size_t i = 0; i < terms.size(); ++i)
    if (!pushing.contains(terms.at(i).at("type").text())) return false;
  return true;
}

void check_freedom(const Subject& subject, Warnings& out) {
  check_drift(subject, out);
  check_ground(subject, out);
}

}  // namespace orthodyn::input_checks
