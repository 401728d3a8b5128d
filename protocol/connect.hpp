// How the three roles find each other: role r listens for the roles above it and dials those below it.
#pragma once

#include "protocol/mailbox.hpp"
#include "protocol/tcp_endpoint.hpp"

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace triptych {

/// How connecting ended.
struct ConnectOutcome {
  enum class Kind {
    connected,
    session_over,   ///< a peer said so, or `stop` did
    peer_differs,   ///< another protocol version, session or pack, or an address where somebody else listens
    peers_missing,  ///< they did not come in time
    no_such_host,   ///< an address that cannot be resolved
  };
  Kind kind = Kind::session_over;
  std::unique_ptr<Mailbox> mailbox = {};  ///< of a role that is connected
  std::string place = {}, what = {};      ///< of the last three kinds: what an Error would say
  std::vector<Role> missing = {};         ///< of peers that are missing
};

/// The mailbox, or null where the session is over. Error (place, what) for any other outcome.
std::unique_ptr<Mailbox> mailbox_or_error(ConnectOutcome outcome);

/// Connects one role with both of its peers, each by two connections, and checks that they speak the same
/// protocol version and belong to the same session and pack; whether their OpenGLs agree the caller sees in
/// Mailbox::peer_hello.
///
/// `own` says what this role is; its channel does not matter. Dialling is tried again until the timeout, also
/// where a peer goes before all have met. Callers who do not belong here are turned away and do not disturb:
/// what speaks no protocol, who differs, who is connected already, who stays silent. `stop` is asked several
/// times a second.
ConnectOutcome connect_session(const Hello& own, const MakeEndpoint& endpoint,
                               std::chrono::milliseconds timeout, const std::function<bool()>& stop = {});

/// The same over TCP. `listener` is needed by all but the last role; `dial` names every role below this one.
/// key: every connection is encrypted, and whoever does not know the key is a stranger. Error for a role
/// without the addresses or the port that it needs.
ConnectOutcome connect_session(const Hello& own, const Listener* listener,
                               const std::map<Role, Address>& dial, std::chrono::milliseconds timeout,
                               const std::function<bool()>& stop = {}, const SharedKey* key = nullptr);

}  // namespace triptych
