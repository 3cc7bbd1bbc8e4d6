// From an Abaqus file to a displacement: `orthodyn init --from`, `check`, `run`.
#include <sstream>

#include "tests/mesh/refusal.h"
#include "tests/simulation/result_reader.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::written_scene_test {
namespace {

class WrittenScene : public InFolder {};

// A bar of length 10 mm under an end pressure of 1 MPa, free to contract: E = 200 GPa. Lengths are in mm.
const std::string kBar = R"(*NODE
1, 0, 0, 0
2, 10, 0, 0
3, 10, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 10, 0, 1
7, 10, 1, 1
8, 0, 1, 1
*ELEMENT, TYPE=C3D8, ELSET=Bar
1, 1, 2, 3, 4, 5, 6, 7, 8
*NSET, NSET=Foot
1, 4, 5, 8
*MATERIAL, NAME=Steel
*ELASTIC
200000, 0.3
*DENSITY
7.8e-9
*SOLID SECTION, ELSET=Bar, MATERIAL=Steel
*BOUNDARY
Foot, 1
1, 2, 3
5, 2
*STEP
*STATIC
*DLOAD
Bar, P4, 1
*END STEP
)";

// The value of a column in the last row.
double last_value(const fs::path& file, const std::string& column) {
  std::istringstream header(read_text(file));
  std::string line, name;
  std::getline(header, line);
  std::istringstream names(line);
  for (std::size_t k = 0; std::getline(names, name, ','); ++k)
    if (name == column) return read_rows(file).back().at(k);
  ADD_FAILURE() << "no column " << column << " in " << line;
  return 0;
}

// Face F4 of a hexahedron has the nodes 2, 3, 7, 6: the end at x = 10. It moves by -p L / E = -5e-5 mm.
TEST_F(WrittenScene, ABarUnderEndPressureShortensByPressureTimesLengthOverYoungsModulus) {
  write("bar.inp", kBar);
  const CommandResult init = orthodyn("init static bar.yaml --from bar.inp --units mm_t_s");
  ASSERT_EQ(init.exit_code, 0) << init.output;
  const std::string scene = read_text(folder_ / "bar.yaml");
  write("bar.yaml", scene + "\noutput: {probes: {end: {at: [0.01, 0, 0]}}}\n");
  ASSERT_EQ(orthodyn("check bar.yaml").exit_code, 0) << scene;
  const CommandResult run = orthodyn("run bar.yaml --out result");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const double moved = last_value(folder_ / "result/probes.csv", "end.displacement.x [m]");
  EXPECT_NEAR(moved, -5e-8, 1e-6 * 5e-8);
}

// Linear between points and constant after the last, as in Abaqus: (0, 0), (2, 1) is 1/2 at the end of a step of 1 s,
// and this value still holds at 0.5 s.
TEST_F(WrittenScene, StaticsTakeAnAmplitudeAtTheEndOfTheStep) {
  for (const char* points : {"0, 0, 2, 1", "0, 0, 0.25, 7, 0.5, 0.5"}) {
    write("bar.inp", replaced(replaced(kBar, "*STEP", std::string("*AMPLITUDE, NAME=A\n") + points + "\n*STEP"),
                              "*DLOAD", "*DLOAD, AMPLITUDE=A"));
    fs::remove(folder_ / "bar.yaml");
    const CommandResult init = orthodyn("init static bar.yaml --from bar.inp --units mm_t_s");
    ASSERT_EQ(init.exit_code, 0) << init.output;
    const std::string scene = read_text(folder_ / "bar.yaml");
    write("bar.yaml", scene + "\noutput: {probes: {end: {at: [0.01, 0, 0]}}}\n");
    const CommandResult run = orthodyn("run bar.yaml --force --out result");
    ASSERT_EQ(run.exit_code, 0) << run.output << scene;
    EXPECT_NEAR(last_value(folder_ / "result/probes.csv", "end.displacement.x [m]"), -2.5e-8, 1e-6 * 5e-8);
  }
}

// A table of several lines, whose velocity jumps.
TEST_F(WrittenScene, MotionsByAnAmplitudePassTheCheck) {
  write("deck.inp", replaced(replaced(kBar, "*STEP",
                                      "*NSET, NSET=End\n2, 3, 6, 7\n*AMPLITUDE, NAME=A\n"
                                      "0, 0, 1, 1, 2, 0, 3, 1\n4, 0, 5, 1, 6, 0, 7, 1\n*STEP"),
                             "*DLOAD\nBar, P4, 1", "*BOUNDARY, AMPLITUDE=A\nEnd, 1, 1, 0.1"));
  for (const std::string kind : {"scene", "static"}) {
    const CommandResult init = orthodyn("init " + kind + " " + kind + ".yaml --from deck.inp --units mm_t_s");
    ASSERT_EQ(init.exit_code, 0) << init.output;
    EXPECT_EQ(init.output.find("*BOUNDARY"), std::string::npos) << init.output;
    const CommandResult check = orthodyn("check " + kind + ".yaml");
    EXPECT_EQ(check.exit_code, 0) << check.output << read_text(folder_ / (kind + ".yaml"));
  }
}

}  // namespace
}  // namespace orthodyn::written_scene_test
