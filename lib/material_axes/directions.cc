// `axes: {type: directions}`: the same two or three directions in all elements.
#include <optional>

#include "lib/material_axes/axes_source.h"
#include "lib/material_axes/frame.h"
#include "lib/material_axes/given_axes.h"

namespace orthodyn {
namespace {

class Directions : public AxesSource {
 public:
  static const Spec<Directions>& spec() {
    static const auto s =
        Spec<Directions>()
            .key("first", &Directions::first_, "Direction of material axis 1, of any length.")
            .key("second", &Directions::second_,
                 "Material axis 2 is the part of this direction normal to axis 1; axis 3 = 1 x 2.")
            .key("third", &Directions::third_,
                 "Direction of axis 3. If given, all three are used unchanged and must be orthogonal and right-handed.")
            .key("repair", &Directions::repair_, kRepairSentence)
            .check([](const Directions& d, const Config& config) { d.check(config); });
    return s;
  }

  bool uniform() const override { return true; }

  AxesField field(const Mesh&, Warnings& notes) const override {
    if (!third_) return [Q = frame(first_, second_)](const Vec3&, int) { return Q; };
    if (const auto note = repair_note(columns()); !note.empty()) notes.push_back(origin.where + ": " + note);
    return [Q = nearest_axes(columns())](const Vec3&, int) { return Q; };
  }

  SourceLocation origin;

 private:
  void check(const Config& config) const {
    if (!are_independent(first_, second_))
      config.fail("'first' and 'second' are zero or parallel; give two different directions");
    if (!third_ && repair_ != AxesRepair::refuse)
      config.at("repair").fail("is used with 'third' only: axis 2 is the part of 'second' normal to axis 1");
    if (third_) check_axes(columns(), repair_, [&](const std::string& sentence) { config.fail(sentence); });
  }

  Mat3 columns() const {
    Mat3 m;
    m << first_.stableNormalized(), second_.stableNormalized(), third_->stableNormalized();
    return m;
  }

  Vec3 first_{1, 0, 0}, second_{0, 1, 0};
  std::optional<Vec3> third_;
  AxesRepair repair_ = AxesRepair::refuse;
};

const bool directions_registered =
    Registry<AxesSource>::add<Directions>("directions", "The same directions everywhere.");

}  // namespace
}  // namespace orthodyn
