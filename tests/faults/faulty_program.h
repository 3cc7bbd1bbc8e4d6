// Runs orthodyn_failing_writes with a fault at a chosen write.
#pragma once

#include <fstream>
#include <string>

#include "tests/faults/failing_writes.h"
#include "tests/simulation/resume_fixture.h"

namespace orthodyn {

// Shared with the processes under test.
class SharedFaults {
 public:
  SharedFaults(const fs::path& file, WriteFaults::Kind kind, long k) : file_(file) {
    std::ofstream(file, std::ios::binary) << std::string(sizeof(WriteFaults), '\0');
    std::fstream out(file, std::ios::in | std::ios::out | std::ios::binary);
    const WriteFaults begin{kind, k, 0};
    out.write(reinterpret_cast<const char*>(&begin), sizeof begin);
  }
  long counted() const {
    const std::string bytes = read_text(file_);
    return reinterpret_cast<const WriteFaults*>(bytes.data())->counted;
  }

 private:
  fs::path file_;
};

class FaultyProgram : public Resume {
 protected:
  struct Result : CommandResult {
    long writes = 0;  // including those that failed
  };
  // The fault occurs at the k-th write.
  Result orthodyn_with_fault(WriteFaults::Kind kind, long k, const std::string& arguments) const {
    const SharedFaults faults(folder_ / "faults", kind, k);
    const auto result =
        shell("cd " + folder_.string() + " && ORTHODYN_FAILING_WRITES=" + (folder_ / "faults").string() + " " +
              program("orthodyn_failing_writes") + " " + arguments);
    return {{result.exit_code, result.output}, faults.counted()};
  }
};

}  // namespace orthodyn
