// Three directions as a user gives them, and what is done about those that are no axes: refused with
// the figures, or repaired and told.
#pragma once

#include <functional>

#include "lib/config/values.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

enum class AxesRepair { refuse, orthonormalise };

template <>
struct EnumNames<AxesRepair> {
  static constexpr std::array<std::pair<AxesRepair, const char*>, 2> list{
      {{AxesRepair::refuse, "refuse"}, {AxesRepair::orthonormalise, "orthonormalise"}}};
};

inline constexpr const char* kRepairSentence =
    "What to do with axes that are not orthogonal, or left-handed, by more than rounding (1e-3): an "
    "error, or the nearest rotation, with a note.";

// What keeps the columns from being right-handed orthonormal axes to within `kTypedDigits`, or "".
std::string defect_of_axes(const Mat3& columns);
inline constexpr double kTypedDigits = 1e-3;

// Whether the columns span space, so that there is a rotation to repair them to.
bool span_space(const Mat3& columns);

// The rotation nearest to the columns, made of unit length, in the Frobenius norm (polar decomposition);
// of a left-handed set the third is reversed first, which means nothing to an orthotropic material.
Mat3 nearest_axes(const Mat3& columns);

// Calls `refuse` with a sentence if the columns are no axes and may not, or cannot, be repaired.
using Refuse = std::function<void(const std::string& sentence)>;
void check_axes(const Mat3& columns, AxesRepair repair, const Refuse& refuse);

// What nearest_axes() changes of a set that has a defect: "<what was found>; repaired, ...", or "".
std::string repair_note(const Mat3& columns);

}  // namespace orthodyn
