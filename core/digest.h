#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

struct XXH3_state_s;

namespace cl {

/// 128 bits that stand for some bytes: equal ones mean equal bytes, unless these were chosen to fool us.
struct Digest {
    uint64_t low = 0, high = 0;
    friend bool operator==(const Digest&, const Digest&) = default;
};

/// For tables by digest: its bits are as good as random.
struct DigestHash {
    size_t operator()(const Digest& d) const noexcept { return size_t(d.low); }
};

/// Makes the digest of numbers that are added one after the other; bits count, so 0 and -0 differ. XXH3, at
/// about the speed of memory.
class Digester {
public:
    Digester();

    template <typename T>
    Digester& add(std::span<const T> numbers) {
        static_assert(std::is_arithmetic_v<T>, "padding would be read");
        add(uint64_t(numbers.size())); // or two spans could trade their ends
        add_bytes(std::as_bytes(numbers));
        return *this;
    }
    template <typename T>
    Digester& add(T number) {
        static_assert(std::is_arithmetic_v<T>, "padding would be read");
        add_bytes(std::as_bytes(std::span(&number, 1)));
        return *this;
    }
    Digester& add(const Digest& part) { return add(part.low).add(part.high); }

    [[nodiscard]] Digest digest() const;

private:
    void add_bytes(std::span<const std::byte> bytes);

    struct Free {
        void operator()(XXH3_state_s* state) const;
    };
    std::unique_ptr<XXH3_state_s, Free> state_;
};

} // namespace cl
