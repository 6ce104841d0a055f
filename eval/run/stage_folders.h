#pragma once
#include <filesystem>
#include <vector>

#include "pipeline/reconstruct.h"

namespace dressform {

// stages/<nn>_<label>/ of a run: artifact.json (parameters, seconds, peak memory, inputs) and a link to the bytes in
// the store. Folders of an earlier run with other numbers or labels are removed.
void write_stage_folders(const std::filesystem::path& stages, const std::vector<StageRecord>& records,
                         const ArtifactStore& store);

// "03_extract": the folder's name of a record.
std::string stage_folder_name(const StageRecord& record);

}  // namespace dressform
