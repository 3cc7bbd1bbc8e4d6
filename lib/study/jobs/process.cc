#include "lib/study/jobs/process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <thread>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kPoll = std::chrono::milliseconds(5);
constexpr int kPollsPerTreeCheck = 20;

// Runs in the child between fork and exec; calls only async-signal-safe functions.
[[noreturn]] void execute(char* const* argv, const char* log, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // the child dies with its parent
  if (getppid() != parent) _exit(127);
  setpgid(0, 0);  // Ctrl-C reaches only the parent, which ends the child
  sigset_t none;  // the child blocks no signals
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  if (const int in = open("/dev/null", O_RDONLY | O_CLOEXEC); in >= 0) dup2(in, STDIN_FILENO);
  const int out = open(log, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (out >= 0) {
    dup2(out, STDOUT_FILENO);
    dup2(out, STDERR_FILENO);
  }
  execvp(argv[0], argv);
  _exit(127);
}

// A process and all its descendants, including MPI ranks, which leave the process group.
std::vector<pid_t> process_tree(pid_t process) {
  namespace fs = std::filesystem;
  std::vector<pid_t> all{process};
  for (std::size_t k = 0; k < all.size(); ++k) {
    std::error_code gone;
    const std::string tasks = "/proc/" + std::to_string(all[k]) + "/task";
    for (fs::directory_iterator thread(tasks, gone), end; !gone && thread != end; thread.increment(gone)) {
      std::ifstream children(thread->path() / "children");
      for (pid_t child = 0; children >> child;) all.push_back(child);
    }
  }
  return all;
}

// Resident memory, bytes. A limit of the address space (RLIMIT_AS) would make OpenBLAS hang.
double memory_in_use(pid_t process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/statm");
  double addresses = 0, resident = 0;
  in >> addresses >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

// Memory of a process and its descendants, bytes; shared pages count once.
double memory_of_tree(pid_t process) {
  const std::vector<pid_t> all = process_tree(process);
  if (all.size() == 1) return memory_in_use(process);
  double sum = 0;
  for (const pid_t one : all) {
    std::ifstream in("/proc/" + std::to_string(one) + "/smaps_rollup");
    for (std::string line; std::getline(in, line);)
      if (line.starts_with("Pss:")) sum += 1024 * std::strtod(line.c_str() + 4, nullptr);
  }
  return sum;
}

ProcessEnd ended(int status) {
  if (WIFSIGNALED(status)) return {ProcessEnd::Kind::signalled, WTERMSIG(status)};
  return {ProcessEnd::Kind::exited, WEXITSTATUS(status)};
}

void kill_and_reap(pid_t child) {
  kill(child, SIGSTOP);  // prevents new children
  std::vector<pid_t> all = process_tree(child);
  for (auto process = all.rbegin(); process != all.rend(); ++process) kill(*process, SIGKILL);
  kill(-child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
}

// Kills a child process and its descendants on destruction, unless it has ended.
class ChildProcess {
 public:
  explicit ChildProcess(pid_t process) : process_(process) {}
  ~ChildProcess() {
    if (process_ > 0) kill_and_reap(process_);
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  void has_ended() { process_ = 0; }

 private:
  pid_t process_;
};

}  // namespace

ProcessEnd run_process(const std::vector<std::string>& argv, const std::filesystem::path& log,
                       const ProcessLimits& limits, const Stop& stop) {
  std::vector<char*> arguments;
  for (const auto& a : argv) arguments.push_back(const_cast<char*>(a.c_str()));
  arguments.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child < 0) throw RunError(std::string("cannot start a process: ") + std::strerror(errno));
  if (child == 0) execute(arguments.data(), log.c_str(), parent);
  ChildProcess process(child);
  setpgid(child, child);  // as in execute(): either process may run first

  const auto end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limits.seconds));
  for (long poll = 0;; ++poll) {
    int status = 0;
    const pid_t done = waitpid(child, &status, WNOHANG);
    const bool is_lost = done < 0 && errno != EINTR;
    if (done == child || is_lost) process.has_ended();
    if (done == child) return ended(status);
    if (is_lost) throw RunError(std::string("a process was lost: ") + std::strerror(errno));
    if (stop()) return {ProcessEnd::Kind::interrupted, 0};
    if (Clock::now() > end) return {ProcessEnd::Kind::timed_out, 0};
    const double memory = poll % kPollsPerTreeCheck == 0 ? memory_of_tree(child) : memory_in_use(child);
    if (memory > limits.memory) return {ProcessEnd::Kind::out_of_memory, 0};
    std::this_thread::sleep_for(kPoll);
  }
}

}  // namespace orthodyn
