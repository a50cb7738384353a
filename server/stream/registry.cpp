#include "registry.h"

#include <algorithm>
#include <utility>

namespace sluice::stream {

core::ViewerId Registry::newId() {
  const std::lock_guard lock(mutex_);
  return ++lastId_;
}

void Registry::add(core::ViewerId viewer, std::shared_ptr<Session> session, const std::string& address) {
  const std::lock_guard lock(mutex_);
  sessions_.emplace(viewer, Entry{std::move(session), address});
}

void Registry::remove(core::ViewerId viewer) {
  const std::lock_guard lock(mutex_);
  sessions_.erase(viewer);
}

std::shared_ptr<Session> Registry::find(core::ViewerId viewer) const {
  const std::lock_guard lock(mutex_);
  const auto found = sessions_.find(viewer);
  return found != sessions_.end() ? found->second.session : nullptr;
}

std::vector<std::shared_ptr<Session>> Registry::all() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<Session>> sessions;
  sessions.reserve(sessions_.size());
  for (const auto& [viewer, entry] : sessions_) sessions.push_back(entry.session);
  return sessions;
}

std::size_t Registry::size() const {
  const std::lock_guard lock(mutex_);
  return sessions_.size();
}

std::size_t Registry::sizeFrom(const std::string& address) const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::size_t>(std::count_if(sessions_.begin(), sessions_.end(),
                                                [&](const auto& entry) { return entry.second.address == address; }));
}

}  // namespace sluice::stream
