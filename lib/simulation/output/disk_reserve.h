// Room on a disk that is kept free for what must still be written when the disk is full.
#pragma once

#include <cstddef>
#include <filesystem>

namespace orthodyn {

class DiskReserve {
 public:
  // In a folder, by a file without a name, so that nothing is left of it whatever ends the program. Where there is no
  // such room it keeps none.
  DiskReserve(const std::filesystem::path& folder, std::size_t bytes);
  ~DiskReserve() { release(); }
  DiskReserve(const DiskReserve&) = delete;
  DiskReserve& operator=(const DiskReserve&) = delete;

  // Gives the room back.
  void release();

 private:
  int file_ = -1;
};

}  // namespace orthodyn
