// A role's access to the others over TCP, encrypted where there is a key.
#pragma once

#include "protocol/endpoint.hpp"
#include "protocol/listener.hpp"
#include "protocol/tls.hpp"

#include <map>

namespace triptych {

/// listener: null for a role that is not called. key: null where nothing is encrypted. Both and the context
/// must outlive the endpoint. Error (address) if the listener cannot be used.
std::unique_ptr<Endpoint> tcp_endpoint(asio::io_context& context, const Listener* listener,
                                       const std::map<Role, Address>& addresses, const SharedKey* key);

}  // namespace triptych
