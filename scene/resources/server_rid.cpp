#include "scene/resources/server_rid.h"

#include "servers/visual_server.h"

#include <utility>

namespace cl::scene {

VisualServer* ServerRID::server() const noexcept {
    return server_.lock().get(); // the server outlives the call: everything here runs on the main thread
}

RID ServerRID::in(const VisualServer& server) const noexcept {
    return this->server() == &server ? rid_ : RID{};
}

void ServerRID::adopt(VisualServer& server, RID rid) {
    reset();
    server_ = server.weak();
    rid_ = rid;
}

void ServerRID::reset() noexcept {
    const RID rid = std::exchange(rid_, RID{});
    if (VisualServer* alive = server(); alive && rid) {
        static_cast<void>(alive->free(rid)); // the server logs a RID that somebody else freed
    }
    server_.reset();
}

} // namespace cl::scene
