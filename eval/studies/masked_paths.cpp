#include "eval/studies/masked_paths.h"

#include <cctype>

namespace dressform {
namespace {

bool goes_on_in_name(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) || letter == '_' || letter == '-' || letter == '.';
}

// Whether no name is cut in two: "/a/b" is no part of "/a/bc", nor "a" of "/a".
bool stands_alone(const std::string& text, std::size_t at, std::size_t size) {
  const bool begins = at == 0 || (!goes_on_in_name(text[at - 1]) && text[at - 1] != '/');
  const std::size_t end = at + size;
  // A full stop ends a sentence unless a name goes on behind it.
  const bool stop =
      end < text.size() && text[end] == '.' && (end + 1 == text.size() || !goes_on_in_name(text[end + 1]));
  return begins && (end >= text.size() || stop || !goes_on_in_name(text[end]));
}

std::string without_last_slash(std::string path) {
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path;
}

}  // namespace

std::string with_masked_paths(std::string text, const std::vector<std::pair<std::string, std::string>>& words) {
  for (const auto& [given, word] : words) {
    const std::string path = without_last_slash(given);
    if (path.empty()) continue;
    for (auto at = text.find(path); at != text.npos;) {
      const bool whole = stands_alone(text, at, path.size());
      if (whole) text.replace(at, path.size(), word);
      at = text.find(path, at + (whole ? word.size() : 1));  // behind the word, which may hold the path itself
    }
  }
  return text;
}

}  // namespace dressform
