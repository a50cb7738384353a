#include <algorithm>

#include <google/protobuf/util/message_differencer.h>

#include "annotations.h"
#include "field_path.h"
#include "sluice/core/input_error.h"
#include "sluice/scene/looks.h"
#include "sluice/scene/scene.h"

namespace sluice::scene {

using core::InputError;
using google::protobuf::Message;
using google::protobuf::Reflection;
using google::protobuf::util::MessageDifferencer;

namespace {

/// Moves one field between messages of one type. What `source` does not set goes back to its default.
void moveField(Message& target, Message& source, const FieldStep& step, const std::string& path) {
  const Reflection& reflection = *target.GetReflection();
  const FieldDescriptor& field = *step.field;
  if (step.index >= 0) {
    if (!isMessage(field)) throw InputError("", path, "elements of this list cannot be set one by one");
    reflection.MutableRepeatedMessage(&target, &field, step.index)
        ->CopyFrom(reflection.GetRepeatedMessage(source, &field, step.index));
  } else if (field.is_repeated() || reflection.HasField(source, &field)) {
    reflection.SwapFields(&target, &source, {&field});
  } else {
    reflection.ClearField(&target, &field);
  }
}

bool differ(const Message& before, const Message& after, const FieldDescriptor& field) {
  MessageDifferencer differencer;
  return !differencer.CompareWithFields(before, after, {&field}, {&field});
}

/// Whether what changed between two complete messages takes effect only from the initial state on. Under the scene's
/// `source`, so does every change of what is there at all: another solver, another kernel.
bool needsRestart(const Message& before, const Message& after, bool underSource) {
  const google::protobuf::Descriptor& type = *before.GetDescriptor();
  const Reflection& reflection = *before.GetReflection();
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    if (!differ(before, after, field)) continue;
    const bool annotated = infoOf(field).apply() == v1::RESTART;
    if (!isMessage(field) || isVector(field)) {
      if (annotated) return true;
      continue;
    }
    const google::protobuf::OneofDescriptor* oneof = field.real_containing_oneof();
    const bool here =
        underSource || (&type == v1::Scene::descriptor() && oneof != nullptr && oneof->name() == "source");
    if (field.is_repeated()) {
      const int size = reflection.FieldSize(before, &field);
      if (size != reflection.FieldSize(after, &field)) {
        if (annotated || here) return true;
        continue;
      }
      for (int k = 0; k < size; ++k) {
        if (needsRestart(reflection.GetRepeatedMessage(before, &field, k),
                         reflection.GetRepeatedMessage(after, &field, k), here)) {
          return true;
        }
      }
    } else if (reflection.HasField(before, &field) != reflection.HasField(after, &field)) {
      if (annotated || here) return true;
    } else if (needsRestart(reflection.GetMessage(before, &field), reflection.GetMessage(after, &field), here)) {
      return true;
    }
  }
  return false;
}

/// What a simulation's walls are made of: a body without its name and what it looks like.
v1::Body wallOf(v1::Body body) {
  body.clear_name();
  body.clear_material();
  if (body.has_mesh()) body.mutable_mesh()->clear_normals();
  return body;
}

/// Whether bodies that a simulated fluid flows around have changed. Elsewhere they are only drawn.
bool wallsDiffer(const v1::Scene& before, const v1::Scene& after) {
  return after.has_simulation() &&
         !std::ranges::equal(before.bodies(), after.bodies(), [](const v1::Body& a, const v1::Body& b) {
           return MessageDifferencer::Equals(wallOf(a), wallOf(b));
         });
}

/// Looks that an update has given as a whole have their presets under them.
void applyPresetsOf(v1::Scene& scene, const google::protobuf::FieldMask& mask) {
  for (const std::string& path : mask.paths()) {
    const Place place = resolve(scene, path);
    const Reflection& reflection = *place.holder->GetReflection();
    if (place.step.field->message_type() != v1::Look::descriptor()) continue;
    if (!place.step.field->is_repeated()) {
      applyPreset(static_cast<v1::Look&>(*reflection.MutableMessage(place.holder, place.step.field)));
    } else {
      for (v1::Look& look : *scene.mutable_more_looks()) applyPreset(look);
    }
  }
}

}  // namespace

Update applyUpdate(const v1::Scene& current, const v1::Scene& partial, const google::protobuf::FieldMask& mask) {
  if (mask.paths().empty()) throw InputError("", "", "the update's mask names no field");
  Update update{current, false};
  for (const std::string& path : mask.paths()) {
    v1::Scene given = partial;
    const Place source = resolve(given, path);
    const Place target = resolve(update.scene, path);
    moveField(*target.holder, *source.holder, target.step, path);
    if (isPreset(*target.step.field)) replaceByPreset(static_cast<v1::Look&>(*target.holder));
  }
  applyPresetsOf(update.scene, mask);
  complete(update.scene);
  validate(update.scene);
  update.restart = needsRestart(current, update.scene, false) || wallsDiffer(current, update.scene);
  return update;
}

}  // namespace sluice::scene
