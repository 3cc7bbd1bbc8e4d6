// Bodies without supports: loads that carry them away, ground contact that they penetrate at the start, and contact of
// surfaces that do not face each other.

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lib/fem/contact/contact.h"
#include "lib/mesh/quadratic.h"
#include "lib/mesh/selection.h"
#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn::input_checks {

namespace {

constexpr double kFarAway = 100;  // displacement over the length of the body
constexpr double kInside = 0.02;  // initial penetration over the body's height normal to the ground

NodalExpansion expansion_at(const CheckContext& context, double t) {
  const FemModel& model = *context.built.model;
  return {model.parts(), t, context.built.initial.q, Vector::Zero(model.num_dofs())};
}

// Total load without gravity, N.
Vec3 total_load(const CheckContext& context, double t) {
  return load_forces(context.built.model->parts(), expansion_at(context, t)).rowwise().sum();
}

double total_mass(const FemModel& model) {
  const Vector ones = Vector::Ones(model.num_dofs());
  Vector weighted(model.num_dofs());
  model.multiply_mass(ones, weighted);
  return weighted.sum() / 3;
}

struct Drift {
  double farthest = 0;  // largest distance, m
  double until = 0;     // end of the motion, s
};

// Distance by which the loads move the centre of mass from rest. Gravity is excluded: bodies may fall.
Drift carried_away(const CheckContext& context) {
  Vec3 way = Vec3::Zero(), speed = way, before = way;
  double farthest = 0, last = context.start();
  visit_times(context, [&](double t) {
    const double h = t - last;
    const Vec3 now = total_load(context, t);
    way += h * speed + h * h / 6 * (2 * before + now);
    speed += h / 2 * (before + now);
    before = now;
    last = t;
    farthest = std::max(farthest, way.norm());
  });
  return {farthest / total_mass(*context.built.model), last};
}

// True if, throughout the second half of the run, the total load along its last direction exceeds half of its largest
// value; that of an impact does not. False for self-equilibrated loads. `last`: load (N) at the end of the motion.
bool is_steady(const CheckContext& context, const Vec3& last, double until) {
  constexpr double kNone = 1e-6;
  double largest = 0, smallest_along = last.norm();
  int after_start = 0;
  visit_times(context, [&](double t) {
    const Vec3 now = total_load(context, t);
    largest = std::max(largest, now.norm());
    if (t > (context.start() + context.end()) / 2) {
      ++after_start;
      smallest_along = std::min(smallest_along, now.dot(last.stableNormalized()));
    }
  });
  const NodalVector f = load_forces(context.built.model->parts(), expansion_at(context, until));
  const double self_equilibrated = kNone * f.colwise().norm().sum();
  return after_start > 0 && last.norm() > self_equilibrated && smallest_along > largest / 2;
}

// File and line of the loads and of each term; "" if there are none.
std::string places_of_loads(const CheckContext& context) {
  std::string places = context.scene.loads.empty() ? "" : context.config.at("loads").where();
  if (!context.config.has("terms")) return places;
  const Config terms = context.config.at("terms");
  for (std::size_t i = 0; i < terms.size(); ++i) places += (places.empty() ? "" : ", ") + terms.at(i).where();
  return places;
}

void check_drift(const CheckContext& context, Warnings& out) {
  if (!context.is_timed_motion() || !is_free(context)) return;
  const std::string places = places_of_loads(context);
  if (places.empty()) return;
  const auto [way, until] = carried_away(context);
  const Vec3 last = total_load(context, until);
  if (way <= kFarAway * context.extent && is_steady(context, last, until))
    warn(out, places,
         "nothing holds the body, and these loads push it until the end, with {:.3g} N in all: it is carried away "
         "({:.2g} m until {:.4g} s) rather than bent. Is a clamp missing?",
         last.norm(), way, until);
  if (way > kFarAway * context.extent)
    warn(out, places,
         "nothing holds the body, and these loads carry it {:.3g} m away until {:.4g} s, {:.0f} times its length: is a "
         "clamp missing?",
         way, until, way / context.extent);
}

// Nodes of the surface that can touch the ground.
std::set<int> touching_nodes(const Config& term, const Mesh& mesh) {
  std::optional<std::string> surface;
  if (term.has("surface") && !term.at("surface").is_null()) surface = term.at("surface").text();
  const Cells faces = face_cells(mesh, surface_or_all(mesh, surface, SourceLocation()));
  std::set<int> nodes;
  for (std::size_t k = 0; k < faces.size(); ++k) nodes.insert(faces[k].begin(), faces[k].end());
  return nodes;
}

void check_ground(const CheckContext& context, Warnings& out) {
  if (context.is_static() || !context.config.has("terms")) return;
  const FemModel& model = *context.built.model;
  const NodalExpansion nodal = expansion_at(context, context.start());
  const Config terms = context.config.at("terms");
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Config term = terms.at(i);
    if (!term.has("type") || term.at("type").text() != "ground_contact") continue;
    const auto vector_or = [&](const char* key, const Vec3& usual, const char* unit) {
      return term.has(key) ? Value<Vec3>::read(term.at(key), {.unit = unit}) : usual;
    };
    const Vec3 point = vector_or("point", Vec3::Zero(), "m"),
               normal = vector_or("normal", Vec3::UnitZ(), "").normalized();
    const Eigen::RowVectorXd depth = -(normal.transpose() * (nodal.x.colwise() - point));
    double deepest = 0;
    for (const int node : touching_nodes(term, model.parts().mesh)) deepest = std::max(deepest, depth[node]);
    if (deepest <= kInside * (depth.maxCoeff() - depth.minCoeff())) continue;
    warn(out, term.where(),
         "the body starts {} the ground, {:.3g} m deep, and is thrown out of it: is 'point' in m and on the ground, "
         "and does 'normal' point away from the ground?",
         depth.minCoeff() > 0 ? "below" : "partly in", deepest);
  }
}

// Bodies that overlap at the start, or are far nearer than the gap of a barrier.
void check_overlap(const CheckContext& context, Warnings& out) {
  constexpr double kDeep = 1e-3;  // of the extent
  if (context.is_static()) return;
  const FemModel::Parts& parts = context.built.model->parts();
  const NodalExpansion nodal = expansion_at(context, context.start());
  for (const auto& term : parts.loads) {
    const double depth = term->contact() ? term->contact()->pressed_depth(nodal.state()) : 0;
    if (depth > kDeep * context.extent)
      warn(
          out, "terms",
          "{}: the bodies overlap at the start or are far nearer than the gap, under the pressure of a depth of {:.2g} "
          "m, and are thrown apart: move them",
          term->name(), depth);
  }
}

// The sum of the area vectors of a surface, and the middle of its faces; zero for curved or closed surfaces.
struct PlaneSurface {
  Vec3 area = Vec3::Zero(), middle = Vec3::Zero();  // m^2, m
};

PlaneSurface plane_surface(const Mesh& mesh, const std::vector<FaceCorners>& faces) {
  constexpr double kPlane = 0.99;
  PlaneSurface out;
  double total = 0;
  for (const FaceCorners& face : faces) {
    const auto corner = [&](std::size_t k) { return Vec3(mesh.node(face[k])); };
    const Vec3 area = (corner(1) - corner(face.size() == 4 ? 3 : 0)).cross(corner(2) - corner(0)) / 2;
    out.area += area;
    out.middle += area.norm() / 3 * (corner(0) + corner(1) + corner(2));
    total += area.norm();
  }
  out.middle /= total;
  if (out.area.norm() < kPlane * total) out.area.setZero();
  return out;
}

// Contact of plane surfaces that look away from each other, or in one direction: each lies behind the other.
void check_facing(const CheckContext& context, Warnings& out) {
  if (!context.config.has("terms")) return;
  const Mesh& mesh = context.built.model->parts().mesh;
  const Config terms = context.config.at("terms");
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const std::string type = terms.at(i).has("type") ? terms.at(i).at("type").text() : "";
    if ((type != "contact" && type != "barrier_contact") || !terms.at(i).has("between")) continue;
    const Config between = terms.at(i).at("between");
    const auto first = mesh.surfaces.find(between.at(0).text()), second = mesh.surfaces.find(between.at(1).text());
    if (first == mesh.surfaces.end() || second == mesh.surfaces.end() || first == second) continue;
    const PlaneSurface a = plane_surface(mesh, first->second), b = plane_surface(mesh, second->second);
    if (a.area.isZero(0) || b.area.isZero(0)) continue;
    const Vec3 apart = b.middle - a.middle, n = a.area.normalized(), m = b.area.normalized();
    constexpr double kBehind = 2e-3;                                // of the extent; less is an overlap
    const double farthest = std::max(n.dot(apart), -m.dot(apart));  // m in front of the other surface; negative: behind
    const bool look_away = farthest < -kBehind * context.extent;
    const bool alike = n.dot(m) > 0.5;
    if (look_away || alike)
      warn(out, between.where(),
           "'{}' and '{}' {}, so that they cannot touch before bodies pass through each other: name the surfaces that "
           "face each other, or whole bodies",
           first->first, second->first, alike ? "look in the same direction" : "look away from each other");
  }
}

}  // namespace

bool is_free(const CheckContext& context) {
  if (context.has_supports() || !context.scene.motions.empty() || !context.scene.joints.empty()) return false;
  if (!context.config.has("terms")) return true;
  static const std::set<std::string> pushing{"point_load", "nodal_forces", "pressure"};
  const Config terms = context.config.at("terms");
  for (std::size_t i = 0; i < terms.size(); ++i)
    if (!pushing.contains(terms.at(i).at("type").text())) return false;
  return true;
}

void check_freedom(const CheckContext& context, Warnings& out) {
  check_drift(context, out);
  check_ground(context, out);
  check_overlap(context, out);
  check_facing(context, out);
}

}  // namespace orthodyn::input_checks
