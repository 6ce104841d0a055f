#pragma once
#include <string>
#include <utility>
#include <vector>

namespace dressform {

// `text` with every path of `words` replaced by the word beside it, the first ones first, wherever it stands as a whole
// or as the beginning of a longer path: of "/a/b" in "/a/b/c: bad", not in "/a/bc". Empty paths are passed over.
std::string with_masked_paths(std::string text, const std::vector<std::pair<std::string, std::string>>& words);

}  // namespace dressform
