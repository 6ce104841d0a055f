#include "eval/cli/study_workers.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "eval/run/child_process.h"
#include "scenes/error.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

constexpr double kWorkerMemory_mb = 3000;  // of a pipeline at full size, its captures included, with room to spare
constexpr double kNoLimit_s = 1e9;

double available_memory_mb() {
  std::ifstream info("/proc/meminfo");
  std::string name, unit;
  for (double kilobytes = 0; info >> name >> kilobytes; std::getline(info, unit))
    if (name == "MemAvailable:") return kilobytes / 1024;
  return 0;
}

void work(const std::string& line, const fs::path& study, int number) {
  const std::string name = fmt::format("worker{}_of_{}", number, getpid());
  const fs::path output = study / "work" / (name + ".txt"), log = study / "work" / (name + "_log.txt");
  try {
    const ChildResult ended = run_child({line, fs::current_path(), kNoLimit_s, output, log});
    if (!ended.good()) fmt::print(stderr, "warning: a worker ended with {}: {}\n", ended.end_text(), ended.complaint);
  } catch (const InputError& error) {  // what it would have made, this process makes
    fmt::print(stderr, "warning: {}\n", error.what());
  }
  fs::remove(output), fs::remove(log);
}

}  // namespace

StudyWorkers::StudyWorkers(int count, const std::vector<std::string>& arguments, const fs::path& study) {
  std::string line = "exec " + shell_word(fs::read_symlink("/proc/self/exe").string());
  for (const auto& argument : arguments) line += " " + shell_word(argument);
  if (count > 0) fs::create_directories(study / "work");
  for (int number = 1; number <= count; ++number) threads_.emplace_back(work, line, fs::absolute(study), number);
}

StudyWorkers::~StudyWorkers() {
  for (auto& thread : threads_) thread.join();
}

int worth_while_workers(int cores, std::size_t scenes_left) {
  const int by_memory = static_cast<int>(available_memory_mb() / kWorkerMemory_mb);
  return std::max(1, std::min({cores, static_cast<int>(std::min<std::size_t>(scenes_left, 1024)), by_memory}));
}

}  // namespace dressform
