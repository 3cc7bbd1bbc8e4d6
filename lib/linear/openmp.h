// What libraries do with OpenMP.
#pragma once

namespace orthodyn {

// While it lives, loops of OpenMP that this thread comes to run on it alone (of all threads with libgomp before 11);
// without effect where no OpenMP is loaded.
//
// CHOLMOD's supernodal factorisation asks for four threads in each of its loops, whatever the machine has: of 13,500
// unknowns it takes 106 ms on two cores then, 51 ms on one.
class SerialOpenMp {
 public:
  SerialOpenMp();
  ~SerialOpenMp();
  SerialOpenMp(const SerialOpenMp&) = delete;
  SerialOpenMp& operator=(const SerialOpenMp&) = delete;

 private:
  int levels_ = 0;  // of nested loops that ran in parallel before
};

}  // namespace orthodyn
