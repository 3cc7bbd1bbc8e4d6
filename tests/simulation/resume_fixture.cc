#include "tests/simulation/resume_fixture.h"

#include <algorithm>
#include <cmath>

namespace orthodyn {

double difference(const fs::path& a, const fs::path& b) {
  const auto decisions = nlohmann::json::parse(read_text(a / "run.json")).at("integrator");
  const auto scale = [&](const char* key) { return std::stod(decisions.at(key).get<std::string>()); };
  const std::map<std::string, double> scales{{"displacement", scale("position_scale")},
                                             {"velocity", scale("velocity_scale")}};
  const auto times = read_times(a / "frames.pvd");
  EXPECT_EQ(times, read_times(b / "frames.pvd"));
  std::map<std::string, double> squares, count;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const auto digits = std::to_string(k);
    const auto name = "frames/frame_" + std::string(5 - digits.size(), '0') + digits + ".vtu";
    const auto one = read_fields(a / name), other = read_fields(b / name);
    EXPECT_EQ(one.size(), 2u) << name;
    for (const auto& [field, values] : one) {
      const auto& others = other.at(field);
      EXPECT_EQ(values.size(), others.size());
      for (std::size_t i = 0; i < std::min(values.size(), others.size()); ++i)
        squares[field] += std::pow((double{values[i]} - double{others[i]}) / scales.at(field), 2);
      count[field] += static_cast<double>(values.size());
    }
  }
  const auto rms = [&](const char* field) { return std::sqrt(squares[field] / count[field]); };
  return std::max(rms("displacement"), rms("velocity"));
}

void expect_same_times(const fs::path& a, const fs::path& b) {
  for (const char* name : {"energy.csv", "probes.csv", "momentum.csv"}) {
    const auto one = read_rows(a / name), other = read_rows(b / name);
    ASSERT_EQ(one.size(), other.size()) << name;
    for (std::size_t k = 0; k < one.size(); ++k) {
      EXPECT_EQ(one[k][0], other[k][0]) << name;
      EXPECT_EQ(one[k].size(), other[k].size()) << name;
    }
  }
}

}  // namespace orthodyn
