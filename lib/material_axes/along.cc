// `axes: {type: along}`: L along a curve through points, for a branch, a muscle, a bent tube.
#include "lib/config/csv_table.h"
#include "lib/material_axes/axes_source.h"
#include "lib/material_axes/curve.h"
#include "lib/material_axes/frame.h"
#include "lib/material_axes/lrt.h"

namespace orthodyn {

enum class Across { radial, carried };

template <>
struct EnumNames<Across> {
  static constexpr std::array<std::pair<Across, const char*>, 2> list{
      {{Across::radial, "radial"}, {Across::carried, "carried"}}};
};

namespace {

class Along : public AxesSource {
 public:
  static const Spec<Along>& spec() {
    static const auto s = Spec<Along>()
                              .key("points", &Along::points_,
                                   "Points of the curve that L follows, a centripetal Catmull-Rom spline. L is the "
                                   "tangent at the nearest point of the curve.",
                                   {.unit = "m"})
                              .key("file", &Along::file_,
                                   "Instead of `points`, a CSV file with the columns x,y,z (m); relative to the scene.")
                              .key("across", &Along::across_,
                                   "Direction of R. radial: away from the curve; carried: `start_normal`, transported "
                                   "along the curve without rotation about it, the same in a whole cross-section. "
                                   "Elements on the curve always use carried.")
                              .key("start_normal", &Along::start_normal_,
                                   "The carried direction at the start of the curve; default: the coordinate axis "
                                   "least aligned with the curve, projected normal to it.")
                              .key("order", &Along::order_, kLrtSentence)
                              .key("spiral", &Along::spiral_, kSpiralSentence, {.unit = "rad", .range = kSpiralRange})
                              .check([](const Along& a, const Config& config) {
                                if (a.points_.has_value() == a.file_.has_value())
                                  config.fail("give exactly one of points, file");
                                if (!a.points_) return;
                                const Config points = config.at("points");
                                check_points(*a.points_, [&](const std::string& sentence) { points.fail(sentence); });
                              });
    return s;
  }

  AxesField field(const Mesh&, Warnings&) const override {
    const auto curve = std::make_shared<const Curve>(make_curve());
    return [this, curve](const Vec3& place, int) {
      const Curve::FootPoint foot = curve->nearest(place);
      Vec3 arm = place - foot.point;
      arm -= foot.tangent.dot(arm) * foot.tangent;  // has an effect only beyond the ends of the curve
      const bool on_the_curve = !(arm.norm() > 1e-9 * curve->length());
      const Vec3& radial = across_ == Across::carried || on_the_curve ? foot.normal : arm;
      return lrt_axes(foot.tangent, radial, order_, spiral_);
    };
  }

  SourceLocation origin;

 private:
  template <class Refuse>
  static void check_points(const std::vector<Vec3>& points, Refuse&& refuse) {
    if (points.size() < 2) refuse(fmt::format("found {} point; a curve needs at least two", points.size()));
    Vec3 extent = Vec3::Zero();
    for (const Vec3& p : points) extent = extent.cwiseMax((p - points[0]).cwiseAbs());
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      if (!((points[i + 1] - points[i]).norm() > 1e-9 * extent.norm()))
        refuse(fmt::format("points {} and {} coincide; remove one", i, i + 1));
  }

  std::vector<Vec3> read_points() const {
    const CsvTable table = read_csv(*file_, {"x", "y", "z"});
    std::vector<Vec3> points;
    for (std::size_t row = 0; row < table.rows(); ++row)
      points.emplace_back(table.at(row, table.column("x")), table.at(row, table.column("y")),
                          table.at(row, table.column("z")));
    check_points(points, [&](const std::string& sentence) { throw ConfigError(file_->path, sentence); });
    return points;
  }

  Curve make_curve() const {
    const auto points = points_ ? *points_ : read_points();
    Curve curve(points);
    if (!start_normal_) return curve;
    if (start_normal_->isZero(0) || !are_independent(curve.start_tangent(), *start_normal_))
      origin.fail(fmt::format("start_normal is zero or parallel to the curve's start {}; give a direction across it",
                              Value<Vec3>::yaml(curve.start_tangent())));
    return Curve(points, start_normal_);
  }

  std::optional<std::vector<Vec3>> points_;
  std::optional<FilePath> file_;
  Across across_ = Across::radial;
  std::optional<Vec3> start_normal_;
  LrtOrder order_ = LrtOrder::LRT;
  double spiral_ = 0;  // rad
};

const bool along_registered = Registry<AxesSource>::add<Along>(
    "along", "L along a smooth curve through points, at each integration point: a branch, a muscle.");

}  // namespace
}  // namespace orthodyn
