// A full disk in a run of several ranks, of which the first one alone sees it: all end, with one message.
#include "tests/faults/shared_faults.h"
#include "tests/simulation/several_ranks.h"

namespace orthodyn::ranks_full_disk_test {
namespace {

class RanksOnAFullDisk : public SeveralRanks {
 protected:
  // From the k-th write on.
  CommandResult failing(long k, const std::string& arguments) const {
    const SharedFaults faults(folder_ / "faults", WriteFaults::Kind::full, k);
    return shell("cd " + folder_.string() + " && ORTHODYN_FAILING_WRITES=" + (folder_ / "faults").string() + " " +
                 mpirun(2, "orthodyn_failing_writes") + arguments);
  }
};

TEST_F(RanksOnAFullDisk, EndTogether) {
  write("beam.yaml", kBeam + std::string("time: {end: 0.4}\n"
                                         "integrator: {type: generalized_alpha, step: 0.01, rtol: 1e-9}\n"));
  for (const long k : {5, 60}) {
    SCOPED_TRACE(k);
    fs::remove_all(folder_ / "full");
    const auto result = failing(k, "run beam.yaml --quiet --out full");
    EXPECT_EQ(result.exit_code, 3) << result.output;
    EXPECT_EQ(count(result.output, "error: "), 1) << result.output;
    if (!fs::exists(folder_ / "full/frames")) continue;
    for (const auto& frame : fs::directory_iterator(folder_ / "full/frames"))
      EXPECT_NE(read_text(frame.path()).find("</VTKFile>"), std::string::npos) << frame.path();
  }
}

}  // namespace
}  // namespace orthodyn::ranks_full_disk_test
