// Turns of angles over the steps of a run.
#include "lib/simulation/run/turn_count.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/ode/derived_model.h"
#include "lib/scene/build.h"
#include "tests/scene/scenes.h"

namespace orthodyn::turn_count_test {
namespace {

constexpr double kPi = std::numbers::pi;

// A model with two angles: q_0 and q_1 without whole turns, and their rates v_0 and v_1.
class Angular : public DerivedModel {
 public:
  explicit Angular(const Model& original) : DerivedModel(original) {}
  const Traits& traits() const override { return original().traits(); }
  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override {
    original().force(t, q, v, f);
  }
  Angles angles(const State& state) const override {
    const auto within = [](double angle) { return std::remainder(angle, 2 * kPi); };
    return {state.q.head(2).unaryExpr(within), state.v.head(2)};
  }

 private:
  void assemble(double t, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                Linearization& out) const override {
    original().linearize(t, q, v, kind, out);
  }
};

struct Course {
  Course() : scene(read_scene(Config::from_text(kValidScene))), built(build(scene)), model(*built.model) {}
  // The first angle slows down, the second one swings.
  State at(double t) const {
    State state{t, Vector::Zero(built.model->num_dofs()), Vector::Zero(built.model->num_dofs())};
    state.q.head(2) = exact(t);
    state.v.head(2) << 20 - 8 * t, 3 * std::cos(t);
    return state;
  }
  static Vector exact(double t) { return Eigen::Vector2d(20 * t - 4 * t * t, 3 * std::sin(t)); }
  Scene scene;
  BuiltScene built;
  Angular model;
};

TEST(TurnCount, CountsStepsOfMoreThanATurnByTheirRates) {
  const Course course;
  TurnCount turns(course.model, course.at(0));
  for (double t = 0.5; t < 5; t += 0.5) {  // up to 9.5 rad in a step
    turns.advance(course.at(t));
    EXPECT_LE((turns.at(t) - Course::exact(t)).norm(), 1e-12) << t;
  }
}

TEST(TurnCount, KnowsTheTurnsWithinAStep) {
  const Course course;
  TurnCount turns(course.model, course.at(0));
  turns.advance(course.at(0.5));
  for (const double t : {0.1, 0.25, 0.4}) {
    const Vector found = nearest_turns(course.model.angles(course.at(t)).values, turns.at(t));
    EXPECT_LE((found - Course::exact(t)).norm(), 1e-12) << t;
  }
}

TEST(TurnCount, BeginsWithTheTurnsOfItsStateIfThisHasAny) {
  const Course course;
  State start = course.at(2);  // 24 rad
  EXPECT_LE((TurnCount(course.model, start).at(2) - course.model.angles(start).values).norm(), 1e-15);
  start.angles = Course::exact(2) + Eigen::Vector2d(0.1, -0.1);
  EXPECT_LE((TurnCount(course.model, start).at(2) - Course::exact(2)).norm(), 1e-12);
}

TEST(TurnCount, IsEmptyForModelsWithoutAngles) {
  const Course course;
  EXPECT_TRUE(TurnCount(*course.built.model, course.at(0)).empty());
}

}  // namespace
}  // namespace orthodyn::turn_count_test
