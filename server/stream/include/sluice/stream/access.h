#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sluice/v1/session.pb.h"

namespace sluice::stream {

/// Who may come in as what. Without tokens everybody may do everything.
struct Access {
  std::string driverToken;     ///< Opens every role; empty: none is asked for, and `spectatorToken` does not count.
  std::string spectatorToken;  ///< Opens the role of a spectator alone; empty: there is none.

  bool asksForToken() const { return !driverToken.empty(); }

  /// The role that a viewer gets who shows this token and wants that role (unspecified: the highest). None: the token
  /// is not right, or does not open the role. Takes as long whatever part of the token is wrong.
  std::optional<v1::Role> roleFor(std::string_view token, v1::Role wanted) const;
};

/// The token of a header "Authorization: Bearer ..."; empty where there is none.
std::string_view bearerToken(std::string_view authorization);

}  // namespace sluice::stream
