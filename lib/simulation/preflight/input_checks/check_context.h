// The scene that is checked, and helper functions of the input checks. Each file of this folder checks one kind of
// input.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/simulation/preflight/input_checks/input_checks.h"

namespace orthodyn::input_checks {

struct CheckContext {
  CheckContext(const Config& config, const Scene& scene, const BuiltScene& built, bool is_timed);

  const Config& config;
  const Scene& scene;
  const BuiltScene& built;
  bool is_timed;          // false: the time span was not given by the user
  Box box;                // of the body at rest
  double extent = 0;      // longest side of the box, m
  double wave_speed = 0;  // fastest wave speed of any region, m/s

  double start() const { return scene.time.start; }
  double end() const { return scene.time.end; }
  double span() const { return end() - start(); }
  bool is_static() const { return scene.is_static(); }
  // True for a dynamic scene with a time span given by the user.
  bool is_timed_motion() const { return !is_static() && is_timed; }
  bool has_supports() const { return built.model->num_dofs() < 3 * built.model->parts().dofs->num_nodes(); }
  // Shortest over longest side of the box.
  double slenderness() const { return box.size().minCoeff() / extent; }
  double wave_time() const { return extent / wave_speed; }  // time a wave takes along the body, s
  // Lowest frequencies of a cantilever of this size, rad/s: axial, and approximately in bending.
  double lowest_axial_frequency() const { return std::numbers::pi / 2 / wave_time(); }
  double lowest_bending_frequency() const { return kBendingOverAxial * slenderness() * lowest_axial_frequency(); }

  // Lowest bending over lowest axial frequency of a cantilever of length L and height h, times L/h: with the wave speed
  // c, (1.015 c h/L^2) / (pi/2 c/L) L/h.
  static constexpr double kBendingOverAxial = 0.65;
};

// Appends "place: message".
template <class... Arguments>
void warn(Warnings& out, const std::string& place, fmt::format_string<Arguments...> message, Arguments&&... arguments) {
  out.push_back(place + ": " + fmt::format(message, std::forward<Arguments>(arguments)...));
}

// Each check appends its warnings to `out`. The comments name the file.
void check_material(const CheckContext& context, Warnings& out);    // materials.cc
void check_change(const CheckContext& context, Warnings& out);      // changes.cc: of moisture and temperature
void check_place(const CheckContext& context, Warnings& out);       // places.cc: lengths, points and directions
void check_load(const CheckContext& context, Warnings& out);        // loads.cc
void check_time(const CheckContext& context, Warnings& out);        // times.cc
void check_motion(const CheckContext& context, Warnings& out);      // motions.cc: initial and prescribed motions
void check_damping(const CheckContext& context, Warnings& out);     // damping.cc
void check_freedom(const CheckContext& context, Warnings& out);     // freedom.cc: bodies without supports
void check_hourglass(const CheckContext& context, Warnings& out);   // hourglass.cc
void check_layers(const CheckContext& context, Warnings& out);      // layers.cc: plies that share a cell
void check_locking(const CheckContext& context, Warnings& out);     // locking.cc
void check_fibres(const CheckContext& context, Warnings& out);      // fibres.cc
void check_friction(const CheckContext& context, Warnings& out);    // friction.cc
void check_relaxation(const CheckContext& context, Warnings& out);  // relaxation.cc: viscoelastic materials
void check_turning(const CheckContext& context, Warnings& out);     // turning.cc: free rotation
void check_event(const CheckContext& context, Warnings& out);       // events.cc
void check_setting(const CheckContext& context, Warnings& out);     // settings.cc: keys of the integrator

// The value at a path such as "integrator.rtol"; empty if absent or null.
std::optional<Config> find_value(const Config& config, const std::vector<std::string>& path);

// Calls `visit` for each value of a key at any depth.
void visit_keys(const Config& config, const std::string& key, const std::function<void(const Config&)>& visit);

// Calls `visit` for each time function of loads, terms, motions and loads of joints. Skips sections `factor` that a
// plugin uses for something else.
void visit_time_functions(const CheckContext& context, const std::function<void(const Config&)>& visit);
bool is_time_function(const Config& section);

// Calls `visit` for ascending times (s) from start to end: the times at which loads or motions are not smooth, and some
// times between each two of these. Stops at a time where a formula has no value; the run reports the error if it
// reaches that time.
void visit_times(const CheckContext& context, const std::function<void(double)>& visit);

// Sum of all load forces (N) except gravity at a state; one column per node.
NodalVector load_forces(const FemModel::Parts& parts, const NodalExpansion& nodal);

// "18,000" for a large number, "1.8" for a small one.
std::string factor_text(double x);

// Fastest wave speed in a material (m/s): sqrt(max C_ii / density).
double fastest_wave(const Mat6& stiffness, double density);

// True if the body can move freely: no clamps, no moved supports, and no terms other than loads (point_load,
// nodal_forces, pressure).
bool is_free(const CheckContext& context);

// Distance from a point to the box, m.
double distance(const Vec3& point, const Box& box);

}  // namespace orthodyn::input_checks
