#include "lib/mesh/io/abaqus_scopes.h"

#include <cctype>
#include <numbers>

namespace orthodyn {

AbaqusMembers abaqus_number_member(std::int64_t number, FilePlace place) {
  return {.first = number, .last = number, .place = place, .listed = true};
}

void AbaqusScopes::enter(const std::string& name) {
  if (instances_.contains(in_capitals(name))) lines_.fail("*INSTANCE {} is defined twice", TextTokens::quoted(name));
  current_ = {name, next_offset(), read_placement()};
  instances_.emplace(in_capitals(name), current_);
}

const AbaqusScope& AbaqusScopes::instance(const std::string& name) const {
  const auto found = instances_.find(in_capitals(name));
  if (found == instances_.end()) lines_.fail("no *INSTANCE {}", TextTokens::quoted(name));
  return found->second;
}

std::int64_t AbaqusScopes::offset_of(const AbaqusScope& scope) const {
  return scope.instance.empty() && !instances_.empty() ? kAbaqusAssembly : scope.offset;
}

std::int64_t AbaqusScopes::number(std::string_view field, const char* what, std::int64_t offset) const {
  const std::int64_t found = lines_.integer(field, what);
  if (found < 0 || found >= kAbaqusAssembly) lines_.fail("{} is {}; it must be between 0 and 10^15", what, found);
  return found + offset;
}

AbaqusMembers AbaqusScopes::member(std::string_view field, const AbaqusScope& scope) const {
  for (const auto& [key, instance] : instances_) {
    if (field.size() <= key.size() + 1 || field[key.size()] != '.' ||
        in_capitals(std::string(field.substr(0, key.size()))) != key)
      continue;
    return member_within(field.substr(key.size() + 1), instance);
  }
  return member_within(field, scope);
}

AbaqusMembers AbaqusScopes::member_within(std::string_view field, const AbaqusScope& scope) const {
  const bool is_number =
      !field.empty() && (std::isdigit(static_cast<unsigned char>(field[0])) || field[0] == '-' || field[0] == '+');
  if (is_number) return abaqus_number_member(number(field, "a number", offset_of(scope)), lines_.place());
  if (field.empty()) lines_.fail("an empty field among the members of a set");
  return {.set = scope.key(std::string(field)), .place = lines_.place()};
}

// Returns a multiple of a power of ten above all earlier numbers, so that a number plus the offset still shows the
// number within the part.
std::int64_t AbaqusScopes::next_offset() const {
  if (instances_.empty()) return 0;
  std::int64_t power = 1000;
  while (power <= largest_ && power < (std::int64_t{1} << 50)) power *= 10;
  return power * static_cast<std::int64_t>(instances_.size());
}

// Reads a translation, then a rotation about the line from a to b.
AbaqusPlacement AbaqusScopes::read_placement() {
  AbaqusPlacement placement;
  if (lines_.at_keyword()) return placement;
  if (lines_.data().size() > 3) lines_.fail("*INSTANCE: expected three components of a translation");
  for (std::size_t k = 0; k < 3; ++k) placement.t[static_cast<Eigen::Index>(k)] = lines_.real(k, "a translation");
  if (lines_.at_keyword()) return placement;
  const bool complete = lines_.data().size() == 7;
  Vec3 a, b;
  for (std::size_t k = 0; k < 3; ++k) {
    a[static_cast<Eigen::Index>(k)] = lines_.real(k, "a coordinate");
    b[static_cast<Eigen::Index>(k)] = lines_.real(k + 3, "a coordinate");
  }
  const double angle = lines_.real(6, "an angle in degrees") * std::numbers::pi / 180;
  if (!complete || !((b - a).norm() > 0))
    lines_.fail("*INSTANCE: expected two different points of the axis of rotation and an angle in degrees");
  placement.R = Eigen::AngleAxisd(angle, (b - a).normalized()).toRotationMatrix();
  placement.t = a + placement.R * (placement.t - a);
  if (!lines_.at_keyword()) lines_.fail("*INSTANCE: a third data line; expected a translation and a rotation");
  return placement;
}

}  // namespace orthodyn
