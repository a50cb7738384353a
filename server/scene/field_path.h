#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <google/protobuf/message.h>

namespace sluice::scene {

/// One step down from a message: a field, and for an element of a repeated field its index, else -1.
struct FieldStep {
  const google::protobuf::FieldDescriptor* field = nullptr;
  int index = -1;
};

using FieldPath = std::vector<FieldStep>;

/// "simulation.fluids[0].viscosity".
std::string toString(const FieldPath& path);

/// "outer" and "inner" give "outer.inner"; either may be empty.
std::string joinPaths(const std::string& outer, const std::string& inner);

/// A field inside a message tree.
struct Place {
  google::protobuf::Message* holder = nullptr;
  FieldStep step;
};

/// What an index one past the end of a list does.
enum class PastTheEnd : std::uint8_t { Refused, Appends };

/// Walks a path as people write it ("simulation.fluids[0].viscosity") from `root`. Absent messages on the way come into
/// being, which chooses members of oneofs and switches features on; so does the next element of a list of messages,
/// where asked for. Throws InputError naming the segment that does not exist and what does exist there.
Place resolve(google::protobuf::Message& root, const std::string& path, PastTheEnd pastTheEnd = PastTheEnd::Refused);

}  // namespace sluice::scene
