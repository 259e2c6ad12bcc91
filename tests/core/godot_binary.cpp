#include "tests/core/godot_binary.h"

#include "core/variant/variant_components.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace cl::tests {
namespace {

using Type = Variant::Type;
constexpr uint32_t k64BitFlag = 1u << 16;

class Encoder {
public:
    std::vector<BinaryByte> bytes;

    void value(const Variant& v) {
        const auto type = static_cast<uint32_t>(v.type());
        if (v.type() == Type::Int) {
            return integer(type, v.to_int());
        }
        if (v.type() == Type::Real) {
            return real(type, v.to_real());
        }
        word(type);
        payload(v);
    }

private:
    void word(uint32_t w) { raw(&w, sizeof w); }
    void raw(const void* data, size_t size) {
        const auto* p = static_cast<const uint8_t*>(data); // the hosts we test on are little-endian too
        bytes.insert(bytes.end(), p, p + size);
    }
    void pad() {
        while (bytes.size() % 4 != 0) {
            bytes.emplace_back(std::nullopt);
        }
    }
    void integer(uint32_t type, int64_t v) {
        if (v == static_cast<int32_t>(v)) {
            word(type);
            word(static_cast<uint32_t>(v));
        } else {
            word(type | k64BitFlag);
            raw(&v, sizeof v);
        }
    }
    void real(uint32_t type, double v) {
        if (static_cast<double>(static_cast<float>(v)) == v) {
            word(type);
            const auto single = static_cast<float>(v);
            raw(&single, sizeof single);
        } else {
            word(type | k64BitFlag);
            raw(&v, sizeof v);
        }
    }
    void text(std::string_view s) {
        word(static_cast<uint32_t>(s.size()));
        raw(s.data(), s.size());
        pad();
    }
    void path(const NodePath& p) {
        constexpr uint32_t kNewFormat = 0x80000000u;
        word(static_cast<uint32_t>(p.names().size()) | kNewFormat);
        word(static_cast<uint32_t>(p.subnames().size()));
        word(p.is_absolute() ? 1 : 0);
        for (const StringName& name : p.names()) {
            text(name.view());
        }
        for (const StringName& name : p.subnames()) {
            text(name.view());
        }
    }
    template <typename T>
    void list(const PoolArray<T>& pool) {
        word(static_cast<uint32_t>(pool.size()));
        for (const T& element : pool.span()) {
            if constexpr (std::is_same_v<T, std::string>) {
                word(static_cast<uint32_t>(element.size() + 1)); // here Godot counts and stores the end byte
                raw(element.c_str(), element.size() + 1);
                pad();
            } else {
                raw(&element, sizeof element);
            }
        }
        pad();
    }
    void payload(const Variant& v) {
        switch (v.type()) {
        case Type::Nil:
            return;
        case Type::Bool:
            return word(v.to_bool() ? 1 : 0);
        case Type::String:
            return text(*v.get_if<std::string>());
        case Type::NodePath:
            return path(*v.get_if<NodePath>());
        case Type::Dictionary:
            word(static_cast<uint32_t>(v.get_if<Dictionary>()->size()));
            for (const auto& entry : v.get_if<Dictionary>()->entries()) {
                value(entry.first);
                value(entry.second);
            }
            return;
        case Type::Array:
            word(static_cast<uint32_t>(v.get_if<Array>()->size()));
            for (const Variant& element : *v.get_if<Array>()) {
                value(element);
            }
            return;
        case Type::PoolByteArray:
            return list(*v.get_if<PoolByteArray>());
        case Type::PoolIntArray:
            return list(*v.get_if<PoolIntArray>());
        case Type::PoolRealArray:
            return list(*v.get_if<PoolRealArray>());
        case Type::PoolStringArray:
            return list(*v.get_if<PoolStringArray>());
        case Type::PoolVector2Array:
            return list(*v.get_if<PoolVector2Array>());
        case Type::PoolVector3Array:
            return list(*v.get_if<PoolVector3Array>());
        case Type::PoolColorArray:
            return list(*v.get_if<PoolColorArray>());
        default:
            const Components components = components_of(v);
            raw(components.values.data(), static_cast<size_t>(components.count) * sizeof(float));
        }
    }
};

int base64_digit(char c) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const size_t position = kDigits.find(c);
    return position == std::string_view::npos ? -1 : static_cast<int>(position);
}

} // namespace

std::vector<BinaryByte> encode_godot_binary(const Variant& value) {
    Encoder encoder;
    encoder.value(value);
    return std::move(encoder.bytes);
}

std::vector<uint8_t> decode_base64(std::string_view text) {
    std::vector<uint8_t> out;
    uint32_t bits = 0;
    int count = 0;
    while (!text.empty() && text.back() == '=') {
        text.remove_suffix(1);
    }
    for (const char c : text) {
        const int digit = base64_digit(c);
        if (digit < 0) {
            return {};
        }
        bits = (bits << 6) | static_cast<uint32_t>(digit);
        count += 6;
        if (count >= 8) {
            count -= 8;
            out.push_back(static_cast<uint8_t>(bits >> count));
        }
    }
    return out;
}

} // namespace cl::tests
