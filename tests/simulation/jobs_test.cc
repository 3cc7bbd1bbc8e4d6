// `orthodyn run --slurm` and `orthodyn partition`: runs on a cluster.
#include <gtest/gtest.h>

#include "lib/linear/solver.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::jobs_test {
namespace {

using Jobs = InFolder;

TEST_F(Jobs, ARunIsPrintedAsAJob) {
  write("my \"s\".yaml", kSwing);
  const auto printed = orthodyn("run 'my \"s\".yaml' --slurm --ranks 2 --set time.end=0.1");
  EXPECT_EQ(printed.exit_code, 0) << printed.output;
  EXPECT_NE(printed.output.find("#SBATCH --ntasks=2\n"), std::string::npos) << printed.output;
  EXPECT_NE(printed.output.find("\nexec mpirun -n 2 "), std::string::npos) << printed.output;
  const std::string script = orthodyn("run 'my \"s\".yaml' --slurm --set time.end=0.1 --set checkpoint={}").output;
  EXPECT_NE(script.find(" --resume --quiet\n"), std::string::npos) << script;
  write("job.sh", script);  // a shell that plays the scheduler
  for (int time = 0; time < 2; ++time) EXPECT_EQ(shell("cd / && sh " + (folder_ / "job.sh").string()).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/my \"s\"/run.json"));
  EXPECT_EQ(orthodyn("run missing.yaml --slurm").exit_code, 2);
  EXPECT_EQ(orthodyn("run 'my \"s\".yaml' --slurm --ranks 2 --set integrator.type=modal").exit_code, 2);
}

// A line break in a name would end a comment of the script and start a command.
TEST_F(Jobs, NoNameBecomesACommand) {
  for (const std::string break_ : {"\n", "\r", "\t", "\x7f"}) {
    const std::string name = "a" + break_ + "touch made #";
    write(name + ".yaml", kSwing);
    for (const std::string& arguments : {"run '" + name + ".yaml' --slurm", "run '" + name + ".yaml' --slurm --ranks 2",
                                         "run '" + name + ".yaml' --slurm --out 'out" + break_ + "touch made #'"}) {
      const auto result = orthodyn(arguments);
      EXPECT_EQ(result.exit_code, 2) << result.output;
      EXPECT_NE(result.output.find("line break"), std::string::npos) << result.output;
      EXPECT_EQ(result.output.find("#SBATCH"), std::string::npos) << result.output;
    }
    EXPECT_EQ(orthodyn("run '" + name + ".yaml' --slurm --out out/fine").exit_code, 0);  // quoted in its only line
  }
}

TEST_F(Jobs, ARunIsSubmitted) {
  write("s.yaml", kSwing);
  write("sbatch", "#!/bin/sh\necho 4711\n");
  fs::permissions(folder_ / "sbatch", fs::perms::owner_all);
  const auto result = shell("cd " + folder_.string() + " && PATH=" + folder_.string() + ":$PATH " + program() +
                            " run s.yaml --slurm submit --out out/fine/ --set threads=4 --ranks 3 --estimate-error");
  EXPECT_EQ(result.exit_code, 2) << result.output;  // it would repeat the run
  const auto submitted = shell("cd " + folder_.string() + " && PATH=" + folder_.string() + ":$PATH " + program() +
                               " run s.yaml --slurm submit --out out/fine/ --set threads=4 --ranks 3");
  EXPECT_EQ(submitted.exit_code, 0) << submitted.output;
  EXPECT_EQ(submitted.output, "job     4711\n");
  const std::string script = read_text(folder_ / "out/fine.sbatch");
  EXPECT_NE(script.find("#SBATCH --job-name=\"fine\"\n"), std::string::npos) << script;
  EXPECT_NE(script.find("#SBATCH --cpus-per-task=4\n"), std::string::npos) << script;
  EXPECT_NE(script.find("mpirun -n 3 --map-by slot:PE=4 "), std::string::npos) << script;
  EXPECT_FALSE(fs::exists(folder_ / "out/fine"));
}

TEST_F(Jobs, APartitionIsToldForEachNumberOfParts) {
  if (!solver_registry().at("petsc").unavailable.empty()) GTEST_SKIP() << "built without MPI";
  write("s.yaml", kSwing);
  const auto told = orthodyn("partition s.yaml --parts 2,4,1000 --step 1 --exchanges 10 --reductions 10");
  EXPECT_EQ(told.exit_code, 0) << told.output;
  EXPECT_NE(told.output.find("\n  1000  more parts than elements"), std::string::npos) << told.output;
  const auto row = [](const std::string& output, const std::string& parts) {
    const auto at = output.find("\n" + std::string(6 - parts.size(), ' ') + parts + " ");
    return at == std::string::npos ? "" : output.substr(at + 1, output.find('\n', at + 1) - at - 1);
  };
  EXPECT_NE(row(told.output, "2"), "") << told.output;
  // The parts for four ranks do not depend on earlier calls.
  const auto four = orthodyn("partition s.yaml --parts 4 --step 1 --exchanges 10 --reductions 10").output;
  EXPECT_EQ(row(told.output, "4"), row(four, "4"));
  // Nor on the number of threads of the partitioner.
  const std::string large = "partition s.yaml --parts 16 --set 'mesh.cells=[60,12,12]'";
  EXPECT_EQ(orthodyn(large).output, orthodyn(large).output);
  // Two halves of 20 elements with little communication.
  const std::string halves =
      row(orthodyn("partition s.yaml --parts 2 --step 1 --exchanges 1 --latency 1e-9").output, "2");
  EXPECT_NE(halves.find(" 10    1.000 "), std::string::npos) << halves;
  EXPECT_NE(halves.find(" 0.5 s      100 %"), std::string::npos) << halves;
  for (const char* wrong :
       {"--parts 2,x", "--parts 1", "--parts ''", "--step -1 --exchanges 1", "--step 0 --exchanges 1", "--step 1",
        "--step 1 --exchanges 1 --bandwidth 0", "--bandwidth 1e9"}) {
    const auto refused = orthodyn(std::string("partition s.yaml ") + wrong);
    EXPECT_EQ(refused.exit_code, 2) << wrong << refused.output;
  }
}

}  // namespace
}  // namespace orthodyn::jobs_test
