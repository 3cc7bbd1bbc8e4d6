#include "lib/mesh/cylinder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "lib/core/errors.h"
#include "lib/mesh/extrude.h"

namespace orthodyn {
namespace {

using Point = std::array<double, 2>;

// The corners of the core of a cylinder lie at this fraction of the radius.
constexpr double kCore = 0.6;

void require(bool condition, const std::string& message) {
  if (!condition) throw ConfigError(message);
}

void check_size(double size, const char* what) {
  require(size > 0 && std::isfinite(size), fmt::format("{} {} m; it must be positive and finite", what, size));
}

void check_cells(const RoundCells& cells, bool full) {
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
  require(
      6 * plane * cells.along < std::numeric_limits<int>::max(),
      fmt::format("{:.3g} tets; at most {} can be numbered", 6 * plane * cells.along, std::numeric_limits<int>::max()));
}

// Where the rings end, as fractions of the way: 0 first, 1 last. Thicknesses in geometric progression.
std::vector<double> ring_places(const RoundCells& cells) {
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

// The smaller of the sines of the angles at the ends of a diagonal, of both triangles: large is good.
double worst_corner(const Point& o, const Point& a, const Point& b) {
  const auto length = [](const Point& p, const Point& q) { return std::hypot(p[0] - q[0], p[1] - q[1]); };
  const double longest = std::max({length(o, a), length(a, b), length(b, o)});
  return cross(o, a, b) / (longest * longest);
}

// A quadrangle a b c d, counter-clockwise, cut along its better diagonal; `even` decides a tie.
void append_quad(PlaneMesh& plane, int a, int b, int c, int d, bool even) {
  const auto quality = [&](int i, int j, int k) {
    const auto at = [&](int n) { return plane.nodes[static_cast<std::size_t>(n)]; };
    return worst_corner(at(i), at(j), at(k));
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

// Rings of quadrangles outward from the loop of nodes `inside` (counter-clockwise) to the circle.
// Returns the nodes of the circle.
std::vector<int> append_rings(PlaneMesh& plane, std::vector<int> inside, double first_angle, double radius,
                              const RoundCells& cells) {
  const int count = cells.around;
  const std::vector<double> places = ring_places(cells);
  std::vector<Point> start;
  for (const int n : inside) start.push_back(plane.nodes[static_cast<std::size_t>(n)]);
  for (int ring = 1; ring <= cells.through; ++ring) {
    const double place = places[static_cast<std::size_t>(ring)];
    std::vector<int> outside;
    for (int k = 0; k < count; ++k) {
      const Point end = on_circle(radius, first_angle + 2 * std::numbers::pi * k / count);
      const Point& begin = start[static_cast<std::size_t>(k)];
      outside.push_back(static_cast<int>(plane.nodes.size()));
      plane.nodes.push_back({begin[0] + place * (end[0] - begin[0]), begin[1] + place * (end[1] - begin[1])});
    }
    for (int k = 0; k < count; ++k) {
      const auto here = static_cast<std::size_t>(k), next = static_cast<std::size_t>((k + 1) % count);
      append_quad(plane, inside[here], outside[here], outside[next], inside[next], (k + ring) % 2 == 0);
    }
    inside = std::move(outside);
  }
  return inside;
}

// A square grid blown up half way to a disc: its corners and those of the rings stay blunt.
PlaneMesh make_core(int n, double corner_radius) {
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
      append_quad(plane, a, a + 1, a + n + 2, a + n + 1, (i + j) % 2 == 0);
    }
  }
  return plane;
}

// The nodes on the outline of the grid, counter-clockwise from the corner of lowest coordinates.
std::vector<int> outline_of_core(int n) {
  std::vector<int> loop;
  const auto node = [&](int i, int j) { return i + (n + 1) * j; };
  for (int k = 0; k < n; ++k) loop.push_back(node(k, 0));
  for (int k = 0; k < n; ++k) loop.push_back(node(n, k));
  for (int k = 0; k < n; ++k) loop.push_back(node(n - k, n));
  for (int k = 0; k < n; ++k) loop.push_back(node(0, n - k));
  return loop;
}

// The least rotation that takes z to the unit vector `a`, by Rodrigues' formula: about u = z x a / |z x a| by the angle
// between both. Where a = -z every horizontal u does; x is taken.
Mat3 rotation_from_z(const Vec3& a) {
  const double sine = std::hypot(a[0], a[1]), cosine = a[2];
  const Vec3 u = sine > 0 ? Vec3(-a[1] / sine, a[0] / sine, 0) : Vec3::UnitX();
  Mat3 cross_u;
  cross_u << 0, 0, u[1], 0, 0, -u[0], -u[1], u[0], 0;
  return cosine * Mat3::Identity() + sine * cross_u + (1 - cosine) * u * u.transpose();
}

// Surfaces by which nodes of the plane lie on which circle; then the body is put into place.
TetMesh finish(const PlaneMesh& plane, const std::vector<int>& outer, const std::vector<int>& inner, double length,
               int layers, const Vec3& origin, const Vec3& axis) {
  require(axis.allFinite() && axis.norm() > 0, "the axis is zero or not finite; give a direction");
  require(origin.allFinite(), "the origin is not finite");
  TetMesh mesh = extrude(plane, length, layers);
  const int per_layer = static_cast<int>(plane.nodes.size());
  std::vector<char> side(plane.nodes.size(), 0);
  for (const int n : outer) side[static_cast<std::size_t>(n)] = 'o';
  for (const int n : inner) side[static_cast<std::size_t>(n)] = 'i';
  for (const Triangle& t : boundary_triangles(mesh)) {
    const auto layer = [&](std::size_t k) { return t[k] / per_layer; };
    if (layer(0) == layer(1) && layer(1) == layer(2)) {
      mesh.surfaces[layer(0) == 0 ? "end0" : "end1"].push_back(t);
    } else {
      mesh.surfaces[side[static_cast<std::size_t>(t[0] % per_layer)] == 'o' ? "outer" : "inner"].push_back(t);
    }
  }
  const Mat3 rotation = rotation_from_z(axis.stableNormalized());
  const bool turned = axis.head<2>().norm() > 0 || axis[2] < 0;
  for (Vec3& x : mesh.nodes) x = origin + (turned ? Vec3(rotation * x) : x);
  return mesh;
}

}  // namespace

TetMesh make_cylinder(const CylinderMesh& cylinder) {
  check_size(cylinder.radius, "radius");
  check_size(cylinder.length, "length");
  check_cells(cylinder.cells, true);
  const int n = cylinder.cells.around / 4;
  PlaneMesh plane = make_core(n, kCore * cylinder.radius);
  const double first_angle = -0.75 * std::numbers::pi;  // of the corner of lowest coordinates
  const auto outer = append_rings(plane, outline_of_core(n), first_angle, cylinder.radius, cylinder.cells);
  return finish(plane, outer, {}, cylinder.length, cylinder.cells.along, cylinder.origin, cylinder.axis);
}

TetMesh make_tube(const TubeMesh& tube) {
  check_size(tube.inner_radius, "inner radius");
  check_size(tube.radius, "radius");
  check_size(tube.length, "length");
  require(
      tube.inner_radius < tube.radius,
      fmt::format("inner radius {} m, radius {} m; the inner one must be the smaller", tube.inner_radius, tube.radius));
  check_cells(tube.cells, false);
  PlaneMesh plane;
  std::vector<int> inner;
  for (int k = 0; k < tube.cells.around; ++k) {
    inner.push_back(k);
    plane.nodes.push_back(on_circle(tube.inner_radius, 2 * std::numbers::pi * k / tube.cells.around));
  }
  const auto outer = append_rings(plane, inner, 0, tube.radius, tube.cells);
  return finish(plane, outer, inner, tube.length, tube.cells.along, tube.origin, tube.axis);
}

}  // namespace orthodyn
