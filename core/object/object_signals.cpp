// Signals of an object: connections and their calls.

#include "core/object/class_registry.h"
#include "core/object/object.h"

#include <fmt/core.h>

#include <algorithm>

namespace cl {

namespace {

bool has_flag(ConnectFlags flags, ConnectFlags flag) {
    return (static_cast<uint32_t>(flags) & static_cast<uint32_t>(flag)) != 0;
}

} // namespace

Expected<uint64_t> Object::connect(const StringName& signal, Slot slot, ConnectFlags flags) {
    if (!class_info().has_signal(signal)) {
        return Error{ErrorCode::InvalidArgument,
                     fmt::format("{} has no signal \"{}\"", class_name().view(), signal.view())};
    }
    CL_ASSERT(slot, "connect() of an empty callable");
    const uint64_t id = next_connection_++;
    connections_.push_back({id, signal, std::move(slot), flags});
    return id;
}

void Object::disconnect(const StringName& signal, uint64_t id) {
    const auto found = std::find_if(connections_.begin(), connections_.end(),
                                    [&](const Connection& c) { return c.id == id && c.signal == signal; });
    if (found != connections_.end()) {
        connections_.erase(found);
    }
}

void Object::emit_signal(const StringName& signal, std::span<const Variant> arguments) {
    // Slots may connect, disconnect, emit again and delete this object, so each is found anew by its id, and
    // called as a copy that outlives its connection.
    std::vector<uint64_t> ids;
    for (const Connection& c : connections_) {
        if (c.signal == signal) {
            ids.push_back(c.id);
        }
    }
    if (ids.empty()) {
        return;
    }
    const std::weak_ptr<Object*> self = handle();
    for (const uint64_t id : ids) {
        const auto found = std::find_if(connections_.begin(), connections_.end(),
                                        [id](const Connection& c) { return c.id == id; });
        if (found == connections_.end()) {
            continue;
        }
        const Slot slot = found->slot;
        if (has_flag(found->flags, ConnectFlags::OneShot)) {
            connections_.erase(
                found); // before the call, so that emitting from the slot does not call it again
        }
        slot(arguments);
        if (self.expired()) {
            return;
        }
    }
}

} // namespace cl
