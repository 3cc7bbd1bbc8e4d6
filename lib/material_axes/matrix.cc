// `axes: {type: matrix}`: the same rotation in all elements, given as a matrix.
#include "lib/material_axes/axes_source.h"
#include "lib/material_axes/given_axes.h"

namespace orthodyn {
namespace {

class MatrixAxes : public AxesSource {
 public:
  static const Spec<MatrixAxes>& spec() {
    static const auto s =
        Spec<MatrixAxes>()
            .key("matrix", &MatrixAxes::matrix_,
                 "Rows of the rotation from material to space: its columns are the axes 1, 2, 3.", {.required = true})
            .key("repair", &MatrixAxes::repair_, kRepairSentence)
            .check([](const MatrixAxes& m, const Config& config) {
              check_axes(m.matrix_, m.repair_, [&](const std::string& sentence) {
                config.at("matrix").fail(sentence + " (the axes are the columns)");
              });
            });
    return s;
  }

  bool uniform() const override { return true; }

  AxesField field(const Mesh&, Warnings& notes) const override {
    if (const auto note = repair_note(matrix_); !note.empty()) notes.push_back(origin.where + ": " + note);
    return [Q = nearest_axes(matrix_)](const Vec3&, int) { return Q; };
  }

  SourceLocation origin;

 private:
  Mat3 matrix_ = Mat3::Identity();
  AxesRepair repair_ = AxesRepair::refuse;
};

const bool matrix_registered =
    Registry<AxesSource>::add<MatrixAxes>("matrix", "The same rotation everywhere, with the axes as columns.");

}  // namespace
}  // namespace orthodyn
