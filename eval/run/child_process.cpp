#include "eval/run/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <thread>

#include "scenes/error.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::streamoff kComplaintBytes = 2000;  // of stderr's end: the message with some lines before it
constexpr int kNotStarted = 127;                  // a shell's exit code for a command that it does not find
constexpr std::chrono::microseconds kFirstNap{200}, kLongestNap{20000};  // between two looks whether it has ended

// Only what may be called between fork and exec of a program with threads.
[[noreturn]] void become(const char* line, const char* folder, int output, int log) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int nothing = open("/dev/null", O_RDONLY);
  if (chdir(folder) != 0 || dup2(nothing, 0) < 0 || dup2(output, 1) < 0 || dup2(log, 2) < 0) _exit(kNotStarted);
  execl("/bin/sh", "sh", "-c", line, static_cast<char*>(nullptr));
  _exit(kNotStarted);
}

// A file that a child writes into; closed when this is.
class ChildFile {
 public:
  explicit ChildFile(const fs::path& file)
      : descriptor_(open(file.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0644)) {
    if (descriptor_ < 0) throw InputError(file.string(), "cannot be written; expected a folder that exists");
  }
  ~ChildFile() { close(descriptor_); }
  ChildFile(const ChildFile&) = delete;
  ChildFile& operator=(const ChildFile&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

std::string end_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) return {};
  const std::streamoff size = in.tellg(), from = std::max<std::streamoff>(0, size - kComplaintBytes);
  in.seekg(from);
  std::string text(static_cast<std::size_t>(size - from), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (from > 0) text.erase(0, std::min(text.find('\n'), text.size() - 1) + 1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  return text;
}

// Waits for the end, or for the limit; the status that wait4 gives, and what it used.
int wait_for(pid_t child, double limit_seconds, Clock::time_point start, rusage& used, bool& timed_out) {
  int status = 0;
  auto nap = kFirstNap;
  while (wait4(child, &status, WNOHANG, &used) == 0) {
    if (std::chrono::duration<double>(Clock::now() - start).count() > limit_seconds) {
      timed_out = true;
      kill(-child, SIGKILL);
      wait4(child, &status, 0, &used);
      break;
    }
    std::this_thread::sleep_for(nap);
    nap = std::min(2 * nap, kLongestNap);
  }
  return status;
}

}  // namespace

std::string ChildResult::end_text() const {
  if (timed_out) return fmt::format("no end after {:g} s", limit_seconds);
  if (signal != 0) return fmt::format("signal {} ({})", signal, strsignal(signal));
  return fmt::format("exit code {}", exit_code);
}

ChildResult run_child(const ChildCommand& command) {
  const ChildFile output(command.output), log(command.log);
  const std::string folder = command.folder.string();
  const auto start = Clock::now();
  const pid_t child = fork();
  if (child < 0) throw InputError(command.line, std::string("cannot be started (") + std::strerror(errno) + ")");
  if (child == 0) become(command.line.c_str(), folder.c_str(), output.descriptor(), log.descriptor());
  setpgid(child, child);  // whoever of the two comes first: the group is there before anyone kills it
  ChildResult result;
  result.limit_seconds = command.limit_seconds;
  rusage used{};
  const int status = wait_for(child, command.limit_seconds, start, used, result.timed_out);
  kill(-child, SIGKILL);  // what it left in the background
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  result.peak_memory_mb = static_cast<double>(used.ru_maxrss) / 1024;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  result.complaint = end_of(command.log);
  return result;
}

std::string shell_word(const std::string& text) {
  std::string word = "'";
  for (const char letter : text) word += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return word + "'";
}

}  // namespace dressform
