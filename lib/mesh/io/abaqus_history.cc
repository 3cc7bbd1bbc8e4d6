#include "lib/mesh/io/abaqus_history.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

#include "lib/core/spelling.h"

namespace orthodyn {
namespace {

// Adds a set or surface for a condition under a free name, "boundary_1"; returns its key.
template <class Thing>
std::string add_own(const std::string& keyword, std::map<std::string, Thing>& things) {
  std::string name = keyword;
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (int k = 1;; ++k) {
    Thing own{.name = fmt::format("{}_{}", name, k)};
    own.of_condition = true;
    const std::string key = in_capitals(own.name);
    if (things.emplace(key, std::move(own)).second) return key;
  }
}

// The parameter that asks for another curve than a table of relative values, or "".
std::string unsupported_parameter(const AbaqusKeyword& keyword) {
  static const std::map<std::string, std::vector<std::string>> plain{
      {"DEFINITION", {"TABULAR"}}, {"VALUE", {"RELATIVE"}}, {"TIME", {"STEPTIME", "TOTALTIME"}}};
  for (const auto& [name, value] : keyword.parameters) {
    if (name == "NAME") continue;
    const auto values = plain.find(name);
    const std::string given = abaqus_word(value);
    if (values == plain.end()) return name;
    const bool is_plain = std::any_of(values->second.begin(), values->second.end(), [&](const std::string& word) {
      return !given.empty() && word.starts_with(given);  // words may be shortened
    });
    if (!is_plain) return fmt::format("{}={}", name, value);
  }
  return "";
}

// Reads all numbers in sequence; adds a zero if their count is odd. Empty if a field is not a number.
std::optional<std::vector<double>> amplitude_numbers(AbaqusLines& lines) {
  std::vector<double> numbers;
  while (!lines.at_keyword()) {
    for (const std::string_view field : lines.data()) {
      const std::optional<double> number = abaqus_number(field);
      if (!number) return std::nullopt;
      numbers.push_back(*number);
    }
    if (numbers.size() % 2 == 1 && !lines.at_keyword()) return std::nullopt;
  }
  numbers.resize(numbers.size() + numbers.size() % 2);  // a final zero may be omitted
  return numbers;
}

// Reads the data lines of DEFINITION=TABULAR with relative values. Times count from the start of the first step, where
// step time equals total time. Anything else sets `problem`; it is an error only if a condition uses the amplitude.
AbaqusAmplitude read_amplitude(const AbaqusKeyword& keyword, AbaqusLines& lines) {
  AbaqusAmplitude out{.name = keyword.parameter("NAME"), .place = keyword.place};
  const std::string own = fmt::format("*AMPLITUDE {} (line {})", out.name, out.place.line);
  const std::string other = unsupported_parameter(keyword);
  const auto numbers = amplitude_numbers(lines);
  lines.skip_data();
  if (!other.empty()) out.problem = fmt::format("{} of {} is not read", other, own);
  else if (!numbers || numbers->empty()) out.problem = own + " has no pairs of a time and a value";
  if (!out.problem.empty()) return out;
  for (std::size_t k = 0; k < numbers->size(); k += 2) out.points.push_back({(*numbers)[k], (*numbers)[k + 1]});
  const auto does_not_ascend = [](const auto& a, const auto& b) { return a[0] >= b[0]; };
  if (std::adjacent_find(out.points.begin(), out.points.end(), does_not_ascend) != out.points.end())
    out.problem = fmt::format("the times of {} do not ascend", own);
  return out;
}

// Reads the points a and b: axis 1 points from the origin to a; b lies in the plane of axes 1 and 2, on the side of
// axis 2.
std::optional<std::array<Vec3, 2>> transform_points(AbaqusLines& lines) {
  std::array<Vec3, 2> points{Vec3::Zero(), Vec3::Zero()};
  if (lines.at_keyword()) return std::nullopt;
  const auto& fields = lines.data();
  if (fields.size() > 6) return std::nullopt;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    const std::optional<double> number = abaqus_number(fields[k]);
    if (!number) return std::nullopt;
    points[k / 3][static_cast<Eigen::Index>(k % 3)] = *number;
  }
  return points;
}

bool directions_unchanged(const Vec3& a, const Vec3& b, const Mat3& R) {
  const Vec3 normal = a.cross(b);
  if (!(normal.norm() > 0)) return false;
  Mat3 Q;
  Q.col(0) = a.normalized();
  Q.col(2) = normal.normalized();
  Q.col(1) = Q.col(2).cross(Q.col(0));
  return (R * Q - Mat3::Identity()).norm() < 1e-6;
}

// `R` rotates the directions of the enclosing instance. Points that are not numbers give a transform that is not the
// identity.
AbaqusTransform read_transform(const AbaqusKeyword& keyword, const std::string& set, const Mat3& R,
                               AbaqusLines& lines) {
  AbaqusTransform out{.set = set, .place = keyword.place};
  const std::string type = abaqus_word(keyword.parameter("TYPE"));
  const bool is_rectangular = type.empty() || type[0] == 'R';
  const auto points = transform_points(lines);
  lines.skip_data();
  out.is_identity = is_rectangular && points && directions_unchanged((*points)[0], (*points)[1], R);
  return out;
}

}  // namespace

void AbaqusHistoryReader::read(const AbaqusKeyword& keyword) {
  const std::string& name = keyword.name;
  if (name == "STEP") file_.steps.push_back(keyword);
  if (name == "STATIC" || name == "DYNAMIC" || name == "VISCO" || name == "COUPLEDTEMPERATURE-DISPLACEMENT")
    read_period();
  if (name == "AMPLITUDE") file_.amplitudes[in_capitals(keyword.parameter("NAME"))] = read_amplitude(keyword, lines_);
  if (name == "TRANSFORM")
    file_.transforms.push_back(read_transform(keyword, scopes_.current().key(keyword.parameter("NSET")),
                                              scopes_.current().placement.R, lines_));
  if (name == "BOUNDARY" || name == "CLOAD" || name == "DLOAD" || name == "DSLOAD") read_conditions(keyword);
}

// The period of a step is the second number of its procedure, 1 s if that is missing or zero.
void AbaqusHistoryReader::read_period() {
  if (file_.steps.size() != 1 || lines_.at_keyword()) return;
  const auto& fields = lines_.data();
  const double period = fields.size() > 1 ? abaqus_number(fields[1]).value_or(0) : 0;
  if (period > 0) file_.first_period = period;
}

void AbaqusHistoryReader::read_conditions(const AbaqusKeyword& keyword) {
  std::map<std::string, std::string> made;  // remaining fields -> key of the set created for them
  while (!lines_.at_keyword()) {
    const auto fields = lines_.data();
    if (fields.empty()) continue;
    AbaqusCondition condition{keyword, file_.steps.size(), "", {fields.begin() + 1, fields.end()}, lines_.place()};
    if (fields[0].empty() || set_target(condition, scopes_.member(fields[0]), made))
      file_.conditions.push_back(std::move(condition));
  }
}

bool AbaqusHistoryReader::set_target(AbaqusCondition& condition, const AbaqusMembers& members,
                                     std::map<std::string, std::string>& made) {
  const std::string& name = condition.keyword.name;
  const std::string label = condition.fields.empty() ? "" : abaqus_word(condition.fields[0]);
  const bool of_faces = name == "DLOAD" && label.size() == 2 && label[0] == 'P' && label[1] >= '1' && label[1] <= '6';
  condition.target = members.set;
  if (!of_faces && (!members.set.empty() || name == "DLOAD" || name == "DSLOAD")) return true;
  const auto [found, is_new] = made.try_emplace(join(condition.fields));
  if (is_new) found->second = of_faces ? add_own(name, file_.surfaces) : add_own(name, file_.node_sets);
  condition.target = found->second;
  if (of_faces) file_.surfaces[found->second].faces.push_back({members, static_cast<std::size_t>(label[1] - '1')});
  else file_.node_sets[found->second].members.push_back(members);
  return is_new;
}

}  // namespace orthodyn
