#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <google/protobuf/field_mask.pb.h>

#include "sluice/v1/scene.pb.h"

namespace sluice::scene {

// All functions are thread-safe. Every scene they return is complete (every default filled in, every oneof chosen) and
// valid (every value within its annotated range, every required field set). What cannot be taken is a
// core::InputError that names file, line, column, field path, value and what is allowed.

/// A scene in protobuf text format; `fileName` is for messages alone.
v1::Scene parse(std::string_view text, const std::string& fileName);

/// A scene file. Relative paths inside it are relative to its folder.
v1::Scene load(const std::filesystem::path& file);

/// A field of a scene that names a file.
struct FileReference {
  std::string fieldPath;
  std::string* path;  ///< In the scene.
};

/// Every file that a scene reads.
std::vector<FileReference> filesOf(v1::Scene& scene);

struct ShippedScene {
  std::string name;
  std::string title;
  std::string description;
};

/// The scenes that come with the program, sorted by name.
const std::vector<ShippedScene>& shippedScenes();

bool isShipped(std::string_view name);

/// Throws InputError, listing the names there are, for any other name.
v1::Scene loadShipped(std::string_view name);

/// Applies assignments such as "look.smoothing.time=2", "camera.eye=1,2,3", "simulation.fluids[0].viscosity=0.1" or
/// "look.smoothing.bilateral={}" (which chooses that member of its oneof), in order, then completes and validates. The
/// index one past the end of a list adds an element: "bodies[0].sphere={}". Throws InputError and changes nothing where
/// one of them, or what comes of all, is not allowed.
void assign(v1::Scene& scene, std::span<const std::string> assignments);

/// Fills in every default; leaves feature messages (annotated `feature`) absent.
void complete(google::protobuf::Message& message);

/// Throws InputError at the first value outside its annotation. `pathPrefix` stands before the field path in messages.
void validate(const google::protobuf::Message& message, const std::string& pathPrefix = {});

struct Update {
  v1::Scene scene;
  /// A changed field takes effect only from the initial state on.
  bool restart = false;
};

/// A copy of `current` with the fields that `mask` names taken from `partial`; all or nothing.
Update applyUpdate(const v1::Scene& current, const v1::Scene& partial, const google::protobuf::FieldMask& mask);

}  // namespace sluice::scene
