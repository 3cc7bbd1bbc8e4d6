// What tests of failing writes tell the program, and what it tells them.
#pragma once

#include <fstream>
#include <string>

#include "tests/faults/failing_writes.h"
#include "tests/simulation/result_reader.h"

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

}  // namespace orthodyn
