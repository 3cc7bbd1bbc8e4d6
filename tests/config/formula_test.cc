// Formulas can be evaluated by several threads at once.
#include "lib/config/formula.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace orthodyn::formula_test {
namespace {

TEST(Formula, GivesEveryThreadTheValueAtItsOwnPoint) {
  const PointFormula shared("x + 10*y - z"), copy = shared;
  std::atomic<int> wrong = 0;
  const auto evaluate = [&](const PointFormula& formula, double start) {
    for (int i = 0; i < 20'000; ++i) {
      const Vec3 x(start + i, 2 * start - i, 3 * start);
      if (formula.at(x) != x[0] + 10 * x[1] - x[2]) ++wrong;
    }
  };
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k) threads.emplace_back(evaluate, std::cref(k % 2 ? shared : copy), 1000.0 * k);
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

TEST(Formula, WithoutAValueNamesItsPlaceAndThePoint) {
  try {
    PointFormula("1/x", "a.yaml:3:4: factor").at({0, 1, 2});
    FAIL() << "accepted";
  } catch (const ConfigError& e) {
    EXPECT_EQ(e.place(), "a.yaml:3:4: factor");
    EXPECT_EQ(e.message(), "'1/x' is infinite at x = 0, y = 1, z = 2");
  }
}

TEST(Formula, WhatItsParserSaysEndsWithAFullStop) {
  for (const char* text : {"(1+2", "1+", "nothing", "sin()"}) {
    try {
      PointFormula{text};
      FAIL() << "accepted: " << text;
    } catch (const std::invalid_argument& e) {
      EXPECT_TRUE(std::string(e.what()).ends_with('.')) << e.what();
    }
  }
}

TEST(Formula, WithAUnitIsAnsweredByTheNumberInSIUnits) {
  const Config c = Config::from_text("a: -0.4 mm\nb: 2 apples\n", "s.yaml");
  const auto message = [&](const char* key) -> std::string {
    try {
      Value<PointFormula>::read(c.at(key), {});
    } catch (const ConfigError& e) {
      return e.message();
    }
    return "";
  };
  EXPECT_NE(message("a").find("write -0.0004"), std::string::npos) << message("a");
  EXPECT_NE(message("b").find("cannot read the formula"), std::string::npos) << message("b");
}

TEST(Formula, RefusesAssignmentsAndSeveralValues) {
  for (const char* text : {"t=3", "t = 3", "0,5*t", "t, 2", "t += 1"})
    EXPECT_THROW(TimeFormula{text}, std::invalid_argument) << text;
  EXPECT_EQ(TimeFormula("t == 3 ? 1 : 2").at(3), 1);
  EXPECT_EQ(TimeFormula("t >= 3 ? 1 : 2").at(2), 2);
  EXPECT_EQ(TimeFormula("t <= 3 && t != 2").at(2), 0);
  EXPECT_EQ(TimeFormula("max(0, 5*t)").at(2), 10);
}

TEST(Formula, KnowsWhatItUses) {
  EXPECT_TRUE(TimePointFormula("0.1*sin(t)").uses("t"));
  EXPECT_FALSE(TimePointFormula("0.1*sin(x) + tan(y)").uses("t"));
}

}  // namespace
}  // namespace orthodyn::formula_test
