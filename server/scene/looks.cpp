#include "sluice/scene/looks.h"

#include <algorithm>
#include <memory>

#include <google/protobuf/text_format.h>

#include "annotations.h"
#include "shipped_looks.h"
#include "sluice/core/check.h"

namespace sluice::scene {

using google::protobuf::Message;
using google::protobuf::Reflection;

namespace {

constexpr std::string_view kExtension = ".textproto";

std::string nameOf(const looks::EmbeddedFile& file) {
  SLUICE_CHECK(file.name.ends_with(kExtension));
  return std::string(file.name.substr(0, file.name.size() - kExtension.size()));
}

/// The file's first line is a comment that says what the look is.
std::string descriptionOf(const looks::EmbeddedFile& file) {
  constexpr std::string_view kComment = "# ";
  SLUICE_CHECK(file.text.starts_with(kComment));
  return std::string(file.text.substr(kComment.size(), file.text.find('\n') - kComment.size()));
}

/// Copies what `under` sets and `message` does not.
void putUnder(Message& message, const Message& under) {
  const google::protobuf::Descriptor& type = *message.GetDescriptor();
  const Reflection& reflection = *message.GetReflection();
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    if (field.is_repeated() || !reflection.HasField(under, &field)) continue;
    const google::protobuf::OneofDescriptor* const oneof = field.real_containing_oneof();
    const bool isSet = oneof != nullptr ? reflection.HasOneof(message, oneof) : reflection.HasField(message, &field);
    if (isSet) {
      if (isMessage(field) && !isVector(field) && reflection.HasField(message, &field)) {
        putUnder(*reflection.MutableMessage(&message, &field), reflection.GetMessage(under, &field));
      }
      continue;
    }
    const std::unique_ptr<Message> copy(under.New());
    copy->CopyFrom(under);
    reflection.SwapFields(&message, copy.get(), {&field});
  }
}

}  // namespace

const std::vector<ShippedLook>& shippedLooks() {
  static const std::vector<ShippedLook> kLooks = [] {
    std::vector<ShippedLook> all;
    for (const looks::EmbeddedFile& file : looks::embeddedFiles()) all.push_back({nameOf(file), descriptionOf(file)});
    std::ranges::sort(all, {}, &ShippedLook::name);
    return all;
  }();
  return kLooks;
}

bool isPreset(const FieldDescriptor& field) {
  return &field == v1::Look::descriptor()->FindFieldByNumber(v1::Look::kPresetFieldNumber);
}

void applyPreset(v1::Look& look) {
  if (look.preset().empty()) return;
  for (const looks::EmbeddedFile& file : looks::embeddedFiles()) {
    if (nameOf(file) != look.preset()) continue;
    v1::Look preset;
    SLUICE_CHECK(google::protobuf::TextFormat::ParseFromString(std::string(file.text), &preset));
    putUnder(look, preset);
  }
}

void applyPresets(v1::Scene& scene) {
  if (scene.has_look()) applyPreset(*scene.mutable_look());
  for (v1::Look& look : *scene.mutable_more_looks()) applyPreset(look);
}

void replaceByPreset(v1::Look& look) {
  look.clear_liquid();
  look.clear_noise();
  look.clear_velocity_map();
  applyPreset(look);
}

}  // namespace sluice::scene
