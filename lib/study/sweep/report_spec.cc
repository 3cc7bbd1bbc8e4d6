// Declarations of a sweep's sections `frames` and `plots`, the content of its report.
#include <algorithm>

#include "lib/core/spelling.h"
#include "lib/fem/fem_model.h"
#include "lib/study/sweep/sweep.h"

namespace orthodyn {

namespace {

std::vector<std::string> components_of(const OutputInfo& info) {
  auto all = info.component_names;
  if (all.size() == 6 || (all.size() == 3 && all[0] == "x")) all.push_back("magnitude");
  if (all.size() > 3 && info.unit == "Pa") all.push_back("von_mises");
  return all;
}

// `color` must be FIELD or FIELD.COMPONENT, as the drawing tool expects.
void check_color(const std::string& color, const Config& at) {
  const std::string field = color.substr(0, color.find('.'));
  std::vector<std::string> fields;
  for (const auto& info : FemModel{FemModel::Parts{}}.outputs()) {
    if (info.location == Location::global) continue;
    fields.push_back(info.name);
    if (info.name != field) continue;
    const auto known = components_of(info);
    if (color == field || std::find(known.begin(), known.end(), color.substr(field.size() + 1)) != known.end()) return;
    at.fail("'" + field + "' has no component '" + color.substr(field.size() + 1) + "'" +
            (known.empty() ? "; it is a number" : "; known: " + join(known)));
  }
  at.fail("there is no field '" + field + "'" + did_you_mean(field, fields) + " Known: " + join(fields));
}

void check_frame(const FrameSpec& f, const Config& config) {
  check_color(f.color, config.at("color"));
  if (f.view.size() != 2)
    config.at("view").fail("expected two angles [azimuth, elevation] in degrees", InputFault::form);
  if (f.up != "x" && f.up != "y" && f.up != "z") config.at("up").fail("expected x, y or z, found '" + f.up + "'");
}

}  // namespace

const Spec<FrameSpec>& FrameSpec::spec() {
  static const auto s =
      Spec<FrameSpec>()
          .key("at", &FrameSpec::at, "Time of the pictures; default the end.", {.unit = "s"})
          .key("color", &FrameSpec::color,
               "Field that colours the body: displacement, stress, strain, velocity, det_f.")
          .key("view", &FrameSpec::view, "Azimuth and elevation of the camera, degrees.")
          .key("up", &FrameSpec::up, "Vertical axis: x, y or z.")
          .key("enlarged", &FrameSpec::enlarged, "Scale factor of the deformation.", {.range = kPositive})
          .key("most", &FrameSpec::most,
               "Largest number of pictures; of more points, an evenly spaced selection is shown.", {.range = {1, 100}})
          .key("ghost", &FrameSpec::ghost, "Also draw the outline of the rest shape.")
          .check(check_frame);
  return s;
}

const Spec<PlotSpec>& PlotSpec::spec() {
  static const auto s = Spec<PlotSpec>()
                            .key("metric", &PlotSpec::metric, "Name of one of `quantities`.", {.required = true})
                            .rename("figure", "metric")
                            .key("x", &PlotSpec::x,
                                 "Variable on the horizontal axis; default: the numeric variable with the most values.")
                            .key("lines", &PlotSpec::lines,
                                 "Variable with one line per value; default: another variable with at most 8 values.");
  return s;
}

}  // namespace orthodyn
