// What the rules of slips.h look at, one kind of slip per file of this folder.
#pragma once

#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "lib/simulation/preflight/input_checks/input_checks.h"

namespace orthodyn::input_checks {

struct Subject {
  Subject(const Config& config, const Scene& scene, const BuiltScene& built, bool is_timed);

  const Config& config;
  const Scene& scene;
  const BuiltScene& built;
  bool is_timed;      // otherwise its time span means nothing
  Box box;            // of the body at rest
  double extent = 0;  // m, the longest side of the box
  double wave = 0;    // m/s, of the fastest wave in any of the regions

  double start() const { return scene.time.start; }
  double end() const { return scene.time.end; }
  double span() const { return end() - start(); }
  bool is_static() const { return scene.is_static(); }
  // Over a time span that is known.
  bool moves() const { return !is_static() && is_timed; }
  bool held() const { return built.model->num_dofs() < 3 * built.model->parts().dofs->num_nodes(); }
  // The shortest side of the box over the longest.
  double slenderness() const { return box.size().minCoeff() / extent; }
  double crossing() const { return extent / wave; }  // s, of a wave along the body
  // rad/s, of the lowest vibration along a cantilever, and about that of its bending.
  double lowest_along() const { return std::numbers::pi / 2 / crossing(); }
  double lowest_bending() const { return kBending * slenderness() * lowest_along(); }

  // Of a cantilever's lowest frequencies in bending and along itself, 1.015 h/L^2 and pi/2/L, times L/h.
  static constexpr double kBending = 0.65;
};

void check_material(const Subject& subject, Warnings& out);
void check_place(const Subject& subject, Warnings& out);
void check_load(const Subject& subject, Warnings& out);
void check_time(const Subject& subject, Warnings& out);
void check_motion(const Subject& subject, Warnings& out);
void check_damping(const Subject& subject, Warnings& out);
void check_freedom(const Subject& subject, Warnings& out);
void check_turning(const Subject& subject, Warnings& out);
void check_event(const Subject& subject, Warnings& out);
void check_setting(const Subject& subject, Warnings& out);

// The value at a path such as "integrator.rtol", where it is given and not null.
std::optional<Config> value_at(const Config& config, const std::vector<std::string>& path);

// Calls `visit` for every value of this key, however deep below.
void visit_keys(const Config& config, const std::string& key, const std::function<void(const Config&)>& visit);

// Whether a section is a factor in time; a plugin's term may have another key of that name.
bool names_a_factor(const Config& section);

// For times in s, ascending, from start to end: some between each two where loads and motions are not smooth. Ends
// early where a formula has no value: the run will tell, if it comes so far.
void visit_times(const Subject& subject, const std::function<void(double)>& visit);

// "18,000" of a large number, "1.8" of a small one.
std::string shown_factor(double x);

// m/s, of the fastest wave in a material: sqrt(max C_ii / density).
double fastest_wave(const Material& material);

// True if the body can move freely: the scene has no clamps, no moved supports, and no terms but loads (point_load,
// nodal_forces, pressure).
bool is_free(const Subject& subject);

// m, from a point to the box.
double distance(const Vec3& point, const Box& box);

}  // namespace orthodyn::input_checks
