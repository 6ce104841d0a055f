#pragma once
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace dressform {

// Further processes of this program that work on the same study, to keep all cores busy: a pipeline alone leaves one of
// two idle for a third of its time. They take other scenes by the study's own locks. Their end is waited for.
class StudyWorkers {
 public:
  // `arguments` of each, as of the command line.
  StudyWorkers(int count, const std::vector<std::string>& arguments, const std::filesystem::path& study);
  ~StudyWorkers();
  StudyWorkers(const StudyWorkers&) = delete;
  StudyWorkers& operator=(const StudyWorkers&) = delete;

 private:
  std::vector<std::thread> threads_;  // each waits for one
};

// How many processes are worth while: one a core, as far as there are scenes (with their seeds) to share and memory.
int worth_while_workers(int cores, std::size_t scenes_left);

}  // namespace dressform
