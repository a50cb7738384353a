#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "sluice/core/frame.h"

namespace sluice::stream {

class Session;

/// The sessions there are, by viewer. All methods are thread-safe; none calls into a session.
class Registry {
 public:
  /// Ids rise from 1 and never repeat.
  core::ViewerId newId();

  /// `address` is where the viewer's connection comes from.
  void add(core::ViewerId viewer, std::shared_ptr<Session> session, const std::string& address);
  void remove(core::ViewerId viewer);

  /// Null where there is no such viewer.
  std::shared_ptr<Session> find(core::ViewerId viewer) const;
  std::vector<std::shared_ptr<Session>> all() const;
  std::size_t size() const;
  std::size_t sizeFrom(const std::string& address) const;

 private:
  mutable std::mutex mutex_;
  core::ViewerId lastId_ = 0;
  struct Entry {
    std::shared_ptr<Session> session;
    std::string address;
  };
  std::map<core::ViewerId, Entry> sessions_;
};

}  // namespace sluice::stream
