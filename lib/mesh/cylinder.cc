#include "lib/mesh/cylinder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "lib/core/errors.h"
#include "lib/mesh/extrude.h"
#include "lib/mesh/quadratic.h"

namespace orthodyn {
namespace {

using Point = std::array<double, 2>;

// Radius of the corners of the core, relative to the radius of the cylinder.
constexpr double kCore = 0.6;

void require(bool condition, const std::string& message) {
  if (!condition) throw ConfigError(message);
}

void check_size(double size, const char* what) {
  require(size > 0 && std::isfinite(size), fmt::format("{} {} m; it must be positive and finite", what, size));
}

void check_cells(const RoundMesh& body, bool full) {
  const RoundCells& cells = body.cells;
  require(cells.around >= 3, fmt::format("{} cells around; there must be at least 3", cells.around));
  require(!full || cells.around % 4 == 0,
          fmt::format("{} cells around a full cylinder; they must be a multiple of 4, such as {}", cells.around,
                      4 * (cells.around / 4 + 1)));
  require(cells.through >= 1 && cells.along >= 1,
          fmt::format("{} cells through and {} along; there must be at least 1 of each", cells.through, cells.along));
  require(cells.grading >= 0.01 && cells.grading <= 100,
          fmt::format("grading {}; it must lie in [0.01, 100]", cells.grading));
  const double core = full ? cells.around / 4.0 : 0;
  const double plane = double(cells.around) * cells.through + core * core;
  const double elements = (body.elements == RoundMesh::Elements::hexahedra ? 1 : 6) * plane * cells.along;
  require(elements < std::numeric_limits<int>::max(),
          fmt::format("{:.3g} elements; at most {} can be numbered", elements, std::numeric_limits<int>::max()));
}

// Boundaries of the rings, from 0 (inside) to 1 (outer circle). Thicknesses in geometric progression.
std::vector<double> ring_boundaries(const RoundCells& cells) {
  std::vector<double> places{0};
  for (int ring = 0; ring < cells.through; ++ring) {
    const double along = cells.through == 1 ? 0 : double(ring) / (cells.through - 1);
    places.push_back(places.back() + std::pow(cells.grading, along));
  }
  const double total = places.back();
  for (double& place : places) place /= total;
  places.back() = 1;
  return places;
}

Point on_circle(double radius, double angle) { return {radius * std::cos(angle), radius * std::sin(angle)}; }

double cross(const Point& o, const Point& a, const Point& b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

// Quality of a triangle: twice its area divided by its longest edge squared. Larger is better.
double triangle_quality(const Point& o, const Point& a, const Point& b) {
  const auto length = [](const Point& p, const Point& q) { return std::hypot(p[0] - q[0], p[1] - q[1]); };
  const double longest = std::max({length(o, a), length(a, b), length(b, o)});
  return cross(o, a, b) / (longest * longest);
}

// Adds the quadrilateral a b c d (counter-clockwise), for tetrahedra as two triangles, cut along its better diagonal;
// `even` breaks ties.
void append_quad(PlaneMesh& plane, RoundMesh::Elements elements, int a, int b, int c, int d, bool even) {
  if (elements == RoundMesh::Elements::hexahedra) {
    plane.quadrilaterals.push_back({a, b, c, d});
    return;
  }
  const auto quality = [&](int i, int j, int k) {
    const auto at = [&](int n) { return plane.nodes[static_cast<std::size_t>(n)]; };
    return triangle_quality(at(i), at(j), at(k));
  };
  const double ac = std::min(quality(a, b, c), quality(a, c, d));
  const double bd = std::min(quality(a, b, d), quality(b, c, d));
  if (std::abs(ac - bd) < 1e-9 * std::max(ac, bd) ? even : ac > bd) {
    plane.triangles.push_back({a, b, c});
    plane.triangles.push_back({a, c, d});
  } else {
    plane.triangles.push_back({a, b, d});
    plane.triangles.push_back({b, c, d});
  }
}

// Maps (turn, way) to a point of the plane between an inner loop and the circle. `turn` counts cells around; `way` runs
// from 0 on the loop to 1 on the circle.
struct Rings {
  std::function<Point(double turn)> inside;
  double radius, first_angle;
  int around;

  struct Place {
    double turn, way;
  };
  Point at(const Place& place) const {
    const Point begin = inside(place.turn);
    const Point end = on_circle(radius, first_angle + 2 * std::numbers::pi * place.turn / around);
    return {begin[0] + place.way * (end[0] - begin[0]), begin[1] + place.way * (end[1] - begin[1])};
  }
  // Cells from a to b around the circle, in the shorter direction.
  double turns(const Place& a, const Place& b) const { return std::remainder(b.turn - a.turn, around); }
  Point middle(const Place& a, const Place& b) const { return at({a.turn + turns(a, b) / 2, (a.way + b.way) / 2}); }
};

// The cross section: a plane mesh with rings in its outer part.
struct RoundPlane {
  PlaneMesh mesh = {};
  Rings rings = {};
  std::map<int, Rings::Place> places = {};  // of nodes on rings
  std::vector<int> outer = {}, inner = {};  // nodes on the circles

  // Position of the mid-edge node between two nodes.
  Point middle(int a, int b) const {
    const auto place_a = places.find(a), place_b = places.find(b);
    const bool both = place_a != places.end() && place_b != places.end();
    // A core of a single cell has a diagonal between nodes of the rings.
    if (both && std::abs(rings.turns(place_a->second, place_b->second)) <= 1)
      return rings.middle(place_a->second, place_b->second);
    const Point &p = mesh.nodes[static_cast<std::size_t>(a)], &q = mesh.nodes[static_cast<std::size_t>(b)];
    return {(p[0] + q[0]) / 2, (p[1] + q[1]) / 2};
  }
};

// Adds rings of quadrilaterals from the loop of nodes `inside` (counter-clockwise) outward to the circle.
void append_rings(RoundPlane& round, std::vector<int> inside, const RoundMesh& body) {
  PlaneMesh& plane = round.mesh;
  const RoundCells& cells = body.cells;
  const int count = cells.around;
  const std::vector<double> ways = ring_boundaries(cells);
  for (int k = 0; k < count; ++k) round.places[inside[static_cast<std::size_t>(k)]] = {double(k), 0};
  for (int ring = 1; ring <= cells.through; ++ring) {
    std::vector<int> outside;
    for (int k = 0; k < count; ++k) {
      const Rings::Place place{double(k), ways[static_cast<std::size_t>(ring)]};
      outside.push_back(static_cast<int>(plane.nodes.size()));
      round.places[outside.back()] = place;
      plane.nodes.push_back(round.rings.at(place));
    }
    for (int k = 0; k < count; ++k) {
      const auto here = static_cast<std::size_t>(k), next = static_cast<std::size_t>((k + 1) % count);
      append_quad(plane, body.elements, inside[here], outside[here], outside[next], inside[next], (k + ring) % 2 == 0);
    }
    inside = std::move(outside);
  }
  round.outer = std::move(inside);
}

// A square grid deformed halfway to a disc, which avoids sharp angles at the corners of grid and rings.
PlaneMesh make_core(int n, double corner_radius, RoundMesh::Elements elements) {
  PlaneMesh plane;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double u = 2.0 * i / n - 1, v = 2.0 * j / n - 1;
      const double disc_u = u * std::sqrt(1 - v * v / 2), disc_v = v * std::sqrt(1 - u * u / 2);
      const double square = 1 / std::numbers::sqrt2;
      plane.nodes.push_back({corner_radius * (disc_u + square * u) / 2, corner_radius * (disc_v + square * v) / 2});
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = i + (n + 1) * j;
      append_quad(plane, elements, a, a + 1, a + n + 2, a + n + 1, (i + j) % 2 == 0);
    }
  }
  return plane;
}

// The boundary nodes of the grid, counter-clockwise from the corner with the lowest coordinates.
std::vector<int> outline_of_core(int n) {
  std::vector<int> loop;
  const auto node = [&](int i, int j) { return i + (n + 1) * j; };
  for (int k = 0; k < n; ++k) loop.push_back(node(k, 0));
  for (int k = 0; k < n; ++k) loop.push_back(node(n, k));
  for (int k = 0; k < n; ++k) loop.push_back(node(n - k, n));
  for (int k = 0; k < n; ++k) loop.push_back(node(0, n - k));
  return loop;
}

// The smallest rotation of z to the unit vector a: Rodrigues' formula about u = z x a / |z x a|, or about x if a is -z.
Mat3 rotation_from_z(const Vec3& a) {
  const double sine = std::hypot(a[0], a[1]), cosine = a[2];
  const Vec3 u = sine > 0 ? Vec3(-a[1] / sine, a[0] / sine, 0) : Vec3::UnitX();
  Mat3 cross_u;
  cross_u << 0, 0, u[1], 0, 0, -u[0], -u[1], u[0], 0;
  return cosine * Mat3::Identity() + sine * cross_u + (1 - cosine) * u * u.transpose();
}

// Adds mid-edge nodes that follow the rings.
void make_quadratic_round(Mesh& mesh, const RoundPlane& plane) {
  const int per_layer = static_cast<int>(plane.mesh.nodes.size());
  make_quadratic(mesh, [&](int a, int b) {
    const auto [x, y] = plane.middle(a % per_layer, b % per_layer);
    return Vec3(x, y, 0.5 * (mesh.nodes[static_cast<std::size_t>(a)][2] + mesh.nodes[static_cast<std::size_t>(b)][2]));
  });
}

// Extrudes the cross section, names the surfaces, adds mid-edge nodes for order 2 and places the body.
Mesh finish(const RoundPlane& plane, const RoundMesh& round) {
  const Vec3 &origin = round.origin, &axis = round.axis;
  require(axis.allFinite() && axis.norm() > 0, "the axis is zero or not finite; give a direction");
  require(origin.allFinite(), "the origin is not finite");
  Mesh mesh = extrude(plane.mesh, round.length, round.cells.along);
  const int per_layer = static_cast<int>(plane.mesh.nodes.size());
  std::vector<char> side(plane.mesh.nodes.size(), 0);
  for (const int n : plane.outer) side[static_cast<std::size_t>(n)] = 'o';
  for (const int n : plane.inner) side[static_cast<std::size_t>(n)] = 'i';
  for (const FaceCorners& t : boundary_faces(mesh)) {
    const auto layer = [&](std::size_t k) { return t[k] / per_layer; };
    if (layer(0) == layer(1) && layer(1) == layer(2)) {
      mesh.surfaces[layer(0) == 0 ? "end0" : "end1"].push_back(t);
    } else {
      mesh.surfaces[side[static_cast<std::size_t>(t[0] % per_layer)] == 'o' ? "outer" : "inner"].push_back(t);
    }
  }
  if (round.order == 2) {
    make_quadratic_round(mesh, plane);
    validate(mesh, {"the mesh of order 2"});
  }
  const Mat3 rotation = rotation_from_z(axis.stableNormalized());
  const bool turned = axis.head<2>().norm() > 0 || axis[2] < 0;
  for (Vec3& x : mesh.nodes) x = origin + (turned ? Vec3(rotation * x) : x);
  return mesh;
}

}  // namespace

Mesh make_cylinder(const CylinderMesh& cylinder) {
  check_size(cylinder.radius, "radius");
  check_size(cylinder.length, "length");
  check_cells(cylinder, true);
  const int n = cylinder.cells.around / 4;
  RoundPlane plane{.mesh = make_core(n, kCore * cylinder.radius, cylinder.elements)};
  const auto outline = outline_of_core(n);
  std::vector<Point> loop;
  for (const int node : outline) loop.push_back(plane.mesh.nodes[static_cast<std::size_t>(node)]);
  const auto straight = [loop](double turn) -> Point {
    const double whole = std::floor(turn), part = turn - whole;
    const auto count = static_cast<int>(loop.size());
    const auto at = [&](int k) -> const Point& { return loop[static_cast<std::size_t>((k % count + count) % count)]; };
    const Point &a = at(static_cast<int>(whole)), &b = at(static_cast<int>(whole) + 1);
    return {a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])};
  };
  // The first angle points to the corner with the lowest coordinates.
  plane.rings = {straight, cylinder.radius, -0.75 * std::numbers::pi, cylinder.cells.around};
  append_rings(plane, outline, cylinder);
  return finish(plane, cylinder);
}

Mesh make_tube(const TubeMesh& tube) {
  check_size(tube.inner_radius, "inner radius");
  check_size(tube.radius, "radius");
  check_size(tube.length, "length");
  require(
      tube.inner_radius < tube.radius,
      fmt::format("inner radius {} m, radius {} m; the inner one must be the smaller", tube.inner_radius, tube.radius));
  check_cells(tube, false);
  RoundPlane plane;
  const int around = tube.cells.around;
  const auto circle = [radius = tube.inner_radius, around](double turn) {
    return on_circle(radius, 2 * std::numbers::pi * turn / around);
  };
  plane.rings = {circle, tube.radius, 0, around};
  for (int k = 0; k < around; ++k) {
    plane.inner.push_back(k);
    plane.mesh.nodes.push_back(circle(k));
  }
  append_rings(plane, plane.inner, tube);
  return finish(plane, tube);
}

}  // namespace orthodyn
