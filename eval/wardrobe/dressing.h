#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/fit/fit.h"
#include "pipeline/reconstruct.h"
#include "scenes/mesh_frame.h"

namespace dressform {

// What a run captured, as its store holds it: garments on the mannequin, and the customer who was scanned with them.
struct CapturedClothes {
  std::string name;  // of the run's folder
  KnownBody naked;
  std::optional<KnownBody> user;
  TexturedGarments garments;
  GarmentLayouts layouts;
  ReconstructionOptions options;  // that the run was made with: its fit and correct dress other bodies
};

// Brings a run back from its store; what is not there any more is made again. Throws InputError naming the run where it
// can't be read, or where its fit or correct takes points that a person picked, which other bodies have not.
CapturedClothes captured_clothes(const std::filesystem::path& run, const StageProgress& progress = {});

// Someone to dress.
struct Customer {
  std::string name;
  KnownBody body;
};

// The customer of a run's folder, the user of a scene file (.toml), or a closed body in a mesh file. Throws InputError
// naming the file where it is none of these, or the run has no user.
Customer customer_of(const std::filesystem::path& source, const MeshFrame& frame);

// A number with what it is of: `girth` is a tape's name, or empty.
struct DressedScore {
  std::string slot, metric, unit;
  double value = 0;
};
struct Dressed {
  std::map<std::string, TexturedMesh> garments;  // "top", "bottom", on the body, the body's frame
  GarmentLayouts layouts;
  std::vector<DressedScore> scores;
  long intersecting_pairs = 0;  // with the body and with one another, all slots
};

// The clothes on a body: fitted and corrected as the run's options say, then whatever is worn over the other garment
// lifted over it. Scores: pairs that cut the body and the other garment, ease at chest, waist and hip with its change
// against the mannequin (mm), edge stretch. Throws as the stages do.
Dressed dressed(const CapturedClothes& clothes, const KnownBody& body);

}  // namespace dressform
