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
constexpr int kPollsForFamily = 20;

// In the child, between fork and exec: only what is safe there.
[[noreturn]] void become(char* const* argv, const char* log, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // also when the parent is killed
  if (getppid() != parent) _exit(127);
  setpgid(0, 0);  // Ctrl-C goes to the parent alone, which ends the child
  sigset_t none;  // signals that this program blocks are the child's own
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

// A process and all that it and its children have started, also those that have left its group, as ranks do.
std::vector<pid_t> family(pid_t process) {
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

// Resident memory. Limiting the addresses instead (RLIMIT_AS) has OpenBLAS wait for memory for ever.
double memory_in_use(pid_t process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/statm");
  double addresses = 0, resident = 0;
  in >> addresses >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

// Of a process and what it has started; pages that several have in common count once.
double memory_of_family(pid_t process) {
  const std::vector<pid_t> all = family(process);
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
  kill(child, SIGSTOP);  // it starts no more
  std::vector<pid_t> all = family(child);
  for (auto process = all.rbegin(); process != all.rend(); ++process) kill(*process, SIGKILL);
  kill(-child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
}

// A process that this one waits for: without it, it ends with all that it has started.
class Running {
 public:
  explicit Running(pid_t process) : process_(process) {}
  ~Running() {
    if (process_ > 0) kill_and_reap(process_);
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
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
  if (child == 0) become(arguments.data(), log.c_str(), parent);
  Running process(child);
  setpgid(child, child);  // whoever of the two comes first

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
    const double memory = poll % kPollsForFamily == 0 ? memory_of_family(child) : memory_in_use(child);
    if (memory > limits.memory) return {ProcessEnd::Kind::out_of_memory, 0};
    std::this_thread::sleep_for(kPoll);
  }
}

}  // namespace orthodyn
