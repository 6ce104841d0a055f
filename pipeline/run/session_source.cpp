#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "pipeline/reconstruct.h"
#include "scenes/folder_hash.h"
#include "scenes/hash.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

// A scan has a hash of its own, which stays when only other parts of a session change: captures of other clothes on the
// same mannequin share its model.
LazyArtifact<DepthScan> scan_of(const fs::path& folder, const LazyArtifact<CaptureSession>& session,
                                const std::string& scan, const std::string& sensor) {
  return {hash_hex(sensor + " " + hash_folder(folder / scan)),
          [session, scan] { return session.get().scans.at(scan); }};
}

nlohmann::json read_index(const fs::path& file) {
  std::ifstream in(file);
  if (!in) throw InputError(file.string(), "can't be read; expected a capture session's session.json");
  try {
    return nlohmann::json::parse(in);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(file.string(), std::string("not JSON (") + error.what() + ")");
  }
}

// A reconstruction wants the mannequin scanned, and seen with and without clothes; every listed sensor has a view.
void check_reconstructible(const nlohmann::json& index, const std::string& file) {
  if (!index.at("scans").contains("scan_naked"))
    throw InputError(file + ": scans.scan_naked", "missing; expected the scan of the mannequin");
  const auto& shots = index.at("shots");
  for (const char* which : {"naked", "dressed"})
    if (shots.at(which).empty())
      throw InputError(file + ": shots." + which,
                       std::string("found none; expected at least one sensor's shot of the mannequin ") +
                           (*which == 'n' ? "without" : "with") + " clothes (a scan alone can only be inspected)");
  for (const std::string sensor : index.at("sensors")) {
    const auto has = [&](const char* which) {
      const auto& list = shots.at(which);
      return std::find(list.begin(), list.end(), sensor) != list.end();
    };
    if (!has("naked") && !has("dressed"))
      throw InputError(file + ": sensors",
                       "found \"" + sensor +
                           "\", which has neither a naked nor a dressed shot; expected sensors that "
                           "see the mannequin (take it out of `sensors`; scans name theirs "
                           "themselves)");
  }
}

std::optional<LazyArtifact<Picks>> picks_of(const fs::path& session) {
  if (!fs::exists(session / kPicksFolder)) return {};
  return LazyArtifact<Picks>(picks_content_hash(session), [session] { return read_picks(session).value(); });
}

}  // namespace

SessionSource open_session(const fs::path& folder, bool check) {
  const fs::path at = fs::absolute(folder);
  const LazyArtifact<CaptureSession> lazy(session_content_hash(at), [at] { return read_capture_session(at); });
  if (check) lazy.get();
  const auto picks = picks_of(at);
  if (check && picks) picks->get();
  const auto index = read_index(at / "session.json");
  try {
    check_reconstructible(index, (at / "session.json").string());
    const auto& scans = index.at("scans");
    const std::string naked = scans.at("scan_naked").at("sensor");
    SessionSource source{lazy, scan_of(at, lazy, "scan_naked", naked), {}, index.at("sensors"), naked, {}, picks};
    if (scans.contains("scan_user")) {
      source.scan_user_sensor = scans.at("scan_user").at("sensor");
      source.scan_user = scan_of(at, lazy, "scan_user", source.scan_user_sensor);
    }
    return source;
  } catch (const nlohmann::json::exception& error) {
    throw InputError((at / "session.json").string(), std::string("damaged (") + error.what() + ")");
  }
}

}  // namespace dressform
