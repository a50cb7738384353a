#pragma once

#include <string>

#include <gtest/gtest.h>

#include "sluice/core/input_error.h"
#include "sluice/scene/scene.h"

namespace sluice::scene::test {

/// A small scene that sets only what has to be set.
inline constexpr const char* kSmallScene = R"(simulation {
  container { min { x: -1 y: -1 z: -1 } max { x: 1 y: 1 z: 1 } }
  fluids {
    blocks { first_particle { x: 0 } count_x: 2 }
  }
}
)";

inline v1::Scene smallScene() { return parse(kSmallScene, "small.textproto"); }

/// What `action` throws; an InputError with empty parts when it throws none.
template <class Action>
core::InputError inputError(Action&& action) {
  try {
    action();
  } catch (const core::InputError& error) {
    return error;
  }
  ADD_FAILURE() << "no InputError was thrown";
  return {"", "", ""};
}

}  // namespace sluice::scene::test
