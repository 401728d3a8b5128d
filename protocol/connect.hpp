// How the three roles find each other: role r listens for the roles above it and dials those below it.
#pragma once

#include "protocol/mailbox.hpp"
#include "protocol/tcp_endpoint.hpp"

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace triptych {

/// How connecting ended.
struct ConnectOutcome {
  enum class Kind {
    connected,
    session_over,   ///< the render node said so, or `stop` did
    peer_differs,   ///< another protocol version, session or pack, or another role listens at the address
    peers_missing,  ///< they did not come in time
    no_such_host,   ///< an address that cannot be resolved
    keys_differ,    ///< a role was reached that has another key, or none
  };
  Kind kind = Kind::session_over;
  std::unique_ptr<Mailbox> mailbox = {};  ///< of a role that is connected
  std::string place = {}, what = {};      ///< for the last four kinds: place and text of an Error
  std::vector<Role> missing = {};         ///< for peers_missing: which
  std::set<Role> met = {};  ///< for peers_missing: which were connected meanwhile, for however short
};

/// The mailbox, or null where the session is over. Error (place, what) for any other outcome.
std::unique_ptr<Mailbox> mailbox_or_error(ConnectOutcome outcome);

/// Connects one role with both of its peers, each by two connections, and checks that they speak the same
/// protocol version and belong to the same session and pack; the caller sees in Mailbox::peer_hello whether
/// their OpenGLs agree.
///
/// `own` describes this role; its channel is ignored. Dialling is repeated until the timeout, also where a
/// peer leaves before all have met. Only the render node ends a session: to its peers a switch node that is
/// stopped leaves. Callers that do not belong to the session are turned away and do no harm:
/// those that do not speak the protocol, differ, are connected already, or stay silent. What is wrong with
/// callers, and with roles that hang up without a reason, is said on standard error at once, and once. `stop`
/// is asked several times a second.
ConnectOutcome connect_session(const Hello& own, const MakeEndpoint& endpoint,
                               std::chrono::milliseconds timeout, const std::function<bool()>& stop = {});

/// The same over TCP. `listener` is needed by all but the last role; `dial` names every role below this one.
/// key: every connection is encrypted, and callers that do not know the key are turned away; null: no
/// encryption. Error for a role without the addresses or the port that it needs.
ConnectOutcome connect_session(const Hello& own, const Listener* listener,
                               const std::map<Role, Address>& dial, std::chrono::milliseconds timeout,
                               const std::function<bool()>& stop = {}, const SharedKey* key = nullptr);

}  // namespace triptych
