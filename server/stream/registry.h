#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "sluice/core/frame.h"

namespace sluice::stream {

class Session;

/// The sessions there are, by viewer. All methods are thread-safe; none calls into a session.
class Registry {
 public:
  /// Ids rise from 1 and never repeat.
  core::ViewerId newId();

  void add(core::ViewerId viewer, std::shared_ptr<Session> session);
  void remove(core::ViewerId viewer);

  /// Null where there is no such viewer.
  std::shared_ptr<Session> find(core::ViewerId viewer) const;
  std::vector<std::shared_ptr<Session>> all() const;
  std::size_t size() const;

 private:
  mutable std::mutex mutex_;
  core::ViewerId lastId_ = 0;
  std::map<core::ViewerId, std::shared_ptr<Session>> sessions_;
};

}  // namespace sluice::stream
