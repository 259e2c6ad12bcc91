#pragma once

#include "core/rid.h"

#include <memory>

namespace cl {
class VisualServer;
}

namespace cl::scene {

/// The RID that a resource owns in a server: freed with its holder, unless the server is gone first.
class ServerRID {
public:
    ServerRID() = default;
    ~ServerRID() { reset(); }
    ServerRID(const ServerRID&) = delete;
    ServerRID& operator=(const ServerRID&) = delete;

    /// The RID if it was made in `server`, else the null RID.
    [[nodiscard]] RID in(const VisualServer& server) const noexcept;
    /// The server that the RID lives in; nullptr if there is no RID or that server is gone.
    [[nodiscard]] VisualServer* server() const noexcept;
    [[nodiscard]] RID get() const noexcept { return rid_; }
    /// Takes `rid` of `server` over; frees the one held before.
    void adopt(VisualServer& server, RID rid);
    void reset() noexcept;

private:
    std::weak_ptr<VisualServer> server_;
    RID rid_;
};

} // namespace cl::scene
