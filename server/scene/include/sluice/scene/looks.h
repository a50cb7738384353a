#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sluice/v1/scene.pb.h"

namespace sluice::scene {

struct ShippedLook {
  std::string name;  ///< For `look.preset`.
  std::string description;
};

/// The looks that come with the program, sorted by name. Thread-safe.
const std::vector<ShippedLook>& shippedLooks();

/// Puts the values of the look's preset where the look itself sets none, before defaults are filled in: vectors are
/// whole values, and a chosen member of a oneof stands. Without a preset, or with one that does not exist (which
/// `validate` refuses), nothing changes.
void applyPreset(v1::Look& look);

/// The same for every look of a scene.
void applyPresets(v1::Scene& scene);

/// For a look that had another preset before, all of whose values are filled in: its optics, noise and velocity map
/// become the preset's.
void replaceByPreset(v1::Look& look);

/// Whether a field is `look.preset`, whose change calls for `replaceByPreset`.
bool isPreset(const google::protobuf::FieldDescriptor& field);

}  // namespace sluice::scene
